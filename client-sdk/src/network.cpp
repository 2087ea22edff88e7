#include "network.hpp"

#include <arpa/inet.h>
#include <netdb.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "failure.hpp"

namespace camdir::sdk {

namespace {

bool is_address_character(unsigned char c) {
    return std::isalnum(c) != 0 || std::string(".:-_[]%@").find(static_cast<char>(c)) != std::string::npos;
}

void check_address(const std::string& field, const std::string& text) {
    if (text.empty() || !std::all_of(text.begin(), text.end(), is_address_character)) {
        throw Failure{CDIR_INVALID_ARGUMENT, field + ": '" + text + "' is neither a name nor an address"};
    }
}

bool is_ip_address(const std::string& text) {
    unsigned char bytes[sizeof(in6_addr)];
    return inet_pton(AF_INET, text.c_str(), bytes) == 1 || inet_pton(AF_INET6, text.c_str(), bytes) == 1;
}

std::string element(const std::string& name, const std::string& content) {
    return "<" + name + ">" + content + "</" + name + ">";
}

std::string interface_element(const std::string& name) {
    if (name.empty()) return "<NetworkInterface autodetermine=\"true\"/>";
    check_address("network_interface", name);
    const char* attribute = is_ip_address(name) ? "address" : "name";
    return std::string("<NetworkInterface ") + attribute + "=\"" + name + "\"/>";
}

std::vector<std::string> addresses_of(const std::string& directors) {
    std::vector<std::string> addresses;
    std::size_t begin = 0;
    while (begin <= directors.size()) {
        const std::size_t end = std::min(directors.find(',', begin), directors.size());
        std::string& address = addresses.emplace_back(directors.substr(begin, end - begin));
        std::erase(address, ' ');
        check_address("directors", address);
        begin = end + 1;
    }
    return addresses;
}

std::string peer_elements(const std::string& directors) {
    std::string elements;
    for (const std::string& address : addresses_of(directors))
        elements += "<Peer Address=\"" + address + "\"/>";
    return elements;
}

bool is_known(const std::string& address) {
    const std::size_t colon = address.find(':');
    const bool has_port = colon != std::string::npos && address.find(':', colon + 1) == std::string::npos;
    addrinfo* found = nullptr;
    if (getaddrinfo(address.substr(0, has_port ? colon : std::string::npos).c_str(), nullptr, nullptr,
                    &found) != 0)
        return address.front() == '[';  // "[IPv6 address]:port", which Cyclone DDS reads by itself
    freeaddrinfo(found);
    return true;
}

}  // namespace

std::string network_configuration(const cdir_context_options& options) {
    if (options.cyclone_xml != nullptr) return options.cyclone_xml;
    const std::string general = element("Interfaces", interface_element(options.network_interface)) +
                                element("AllowMulticast", "false") + element("MaxMessageSize", "65500B");
    // With 0 as the highest index, a peer without a port is participant 0 of its host: a director.
    const std::string discovery = element("ParticipantIndex", "none") +
                                  element("MaxAutoParticipantIndex", "0") + element("SPDPInterval", "1s") +
                                  element("Peers", peer_elements(options.directors));
    // Packets to a host that is gone wait for seconds until the kernel has given up looking for its link
    // address, and nothing is sent to anybody once they fill the buffer. The end of a writer waits for
    // receivers, which may have stopped, that acknowledge its last samples.
    const std::string internal = "<SocketSendBufferSize max=\"4MB\"/>" + element("MaxSampleSize", "1MB") +
                                 element("WriterLingerDuration", "50ms");
    return element("CycloneDDS",
                   element("Domain", element("General", general) + element("Discovery", discovery) +
                                         element("Internal", internal)));
}

void require_known_director(const cdir_context_options& options) {
    if (options.cyclone_xml != nullptr) return;
    const std::vector<std::string> addresses = addresses_of(options.directors);
    if (std::any_of(addresses.begin(), addresses.end(), is_known)) return;
    throw Failure{CDIR_NETWORK, "directors: '" + std::string(options.directors) + "' cannot be resolved"};
}

}  // namespace camdir::sdk
