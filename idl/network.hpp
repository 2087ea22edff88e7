// The network configuration of Cyclone DDS that the server and the client library have in common.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace camdir::wire {

// What they do not have in common. Texts need no escapes, but for the elements.
struct Network {
    std::string interface;           // by name or IP address; empty: Cyclone DDS chooses one
    bool multicast = false;          // for discovery
    std::vector<std::string> peers;  // HOST or HOST:PORT
    // The end of a writer waits so long for readers that do not acknowledge its last samples.
    std::chrono::milliseconds writer_linger{0};
    std::string discovery;  // XML elements of Discovery
    std::string internal;   // XML elements of Internal
};

// The configuration of all domains, as XML.
[[nodiscard]] std::string network_xml(const Network& network);

// <name>content</name>
[[nodiscard]] std::string element(const std::string& name, const std::string& content);

}  // namespace camdir::wire
