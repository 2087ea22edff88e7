#include "network.hpp"

#include <netdb.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <vector>

#include "failure.hpp"
#include "idl/network.hpp"

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
    const std::string interface = options.network_interface;
    if (!interface.empty()) check_address("network_interface", interface);
    return wire::network_xml({.interface = interface,
                              .multicast = false,
                              .peers = addresses_of(options.directors),
                              .writer_linger = std::chrono::milliseconds(50),  // they may have stopped
                              // With 0 as the highest index, a peer without a port is participant 0 of its
                              // host: a director.
                              .discovery = wire::element("ParticipantIndex", "none") +
                                           wire::element("MaxAutoParticipantIndex", "0"),
                              .internal = ""});
}

void require_known_director(const cdir_context_options& options) {
    if (options.cyclone_xml != nullptr) return;
    const std::vector<std::string> addresses = addresses_of(options.directors);
    if (std::any_of(addresses.begin(), addresses.end(), is_known)) return;
    throw Failure{CDIR_NETWORK, "directors: '" + std::string(options.directors) + "' cannot be resolved"};
}

}  // namespace camdir::sdk
