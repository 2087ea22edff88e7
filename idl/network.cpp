#include "idl/network.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>

namespace camdir::wire {
namespace {

std::string escaped(const std::string& text) {
    std::string xml;
    for (const char c : text) {
        switch (c) {
            case '&':
                xml += "&amp;";
                break;
            case '<':
                xml += "&lt;";
                break;
            case '>':
                xml += "&gt;";
                break;
            case '"':
                xml += "&quot;";
                break;
            default:
                xml += c;
        }
    }
    return xml;
}

bool is_ip_address(const std::string& text) {
    unsigned char bytes[sizeof(in6_addr)];
    return ::inet_pton(AF_INET, text.c_str(), bytes) == 1 || ::inet_pton(AF_INET6, text.c_str(), bytes) == 1;
}

std::string interface_element(const std::string& interface) {
    if (interface.empty()) return "<NetworkInterface autodetermine=\"true\"/>";
    const std::string attribute = is_ip_address(interface) ? "address" : "name";
    return "<NetworkInterface " + attribute + "=\"" + escaped(interface) + "\"/>";
}

std::string general(const Network& network) {
    return element("General", element("Interfaces", interface_element(network.interface)) +
                                  element("AllowMulticast", network.multicast ? "true" : "false") +
                                  // A camera frame fits into one datagram.
                                  element("MaxMessageSize", "65500B"));
}

std::string discovery(const Network& network) {
    std::string peers;
    for (const std::string& peer : network.peers)
        peers += "<Peer Address=\"" + escaped(peer) + "\"/>";
    if (!peers.empty()) peers = element("Peers", peers);
    // A peer that was not there yet is told of this process so soon.
    return element("Discovery", peers + element("SPDPInterval", "1s") + network.discovery);
}

// A large send buffer, because packets to a host that is gone wait in it for seconds until the kernel has
// given up looking for its link address: once they fill it, nothing is sent to anybody. A limit on samples,
// of which none comes near 1 MB.
std::string internals(const Network& network) {
    return element("Internal",
                   "<SocketSendBufferSize max=\"4MB\"/>" + element("MaxSampleSize", "1MB") +
                       element("WriterLingerDuration", std::to_string(network.writer_linger.count()) + "ms") +
                       network.internal);
}

}  // namespace

std::string element(const std::string& name, const std::string& content) {
    return "<" + name + ">" + content + "</" + name + ">";
}

std::string network_xml(const Network& network) {
    return element("CycloneDDS", "<Domain Id=\"any\">" + general(network) + discovery(network) +
                                     internals(network) + "</Domain>");
}

}  // namespace camdir::wire
