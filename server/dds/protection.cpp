#include "dds/protection.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <sys/select.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

#include "idl/security.hpp"

namespace camdir::dds {
namespace {

bool is_loopback_address(const std::string& text) {
    in_addr v4{};
    in6_addr v6{};
    if (::inet_pton(AF_INET, text.c_str(), &v4) == 1) return ntohl(v4.s_addr) >> 24U == IN_LOOPBACKNET;
    return ::inet_pton(AF_INET6, text.c_str(), &v6) == 1 && IN6_IS_ADDR_LOOPBACK(&v6);
}

using Interfaces = std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)>;

Interfaces interfaces() {
    ifaddrs* found = nullptr;
    return {::getifaddrs(&found) == 0 ? found : nullptr, ::freeifaddrs};
}

bool is_loopback_interface(const std::string& name) {
    const Interfaces list = interfaces();
    for (const ifaddrs* each = list.get(); each != nullptr; each = each->ifa_next)
        if (name == each->ifa_name) return (each->ifa_flags & IFF_LOOPBACK) != 0;
    return false;
}

// Empty: there is none.
std::string loopback_device() {
    const Interfaces list = interfaces();
    for (const ifaddrs* each = list.get(); each != nullptr; each = each->ifa_next)
        if ((each->ifa_flags & IFF_LOOPBACK) != 0) return each->ifa_name;
    return {};
}

// A UDP socket that receives on all interfaces.
bool receives_from_anywhere(int file) {
    int type = 0;
    socklen_t size = sizeof type;
    if (::getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
    sockaddr_storage address{};
    size = sizeof address;
    if (::getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) != 0) return false;
    if (address.ss_family == AF_INET6)
        return IN6_IS_ADDR_UNSPECIFIED(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr);
    return address.ss_family == AF_INET &&
           reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr == INADDR_ANY;
}

constexpr const char* protection =
    "DDS Security (/dds/security names the folder of an identity), or \"insecure\": true in /dds where "
    "strangers "
    "do not reach the network";

Result<void> check_exposure(const config::Dds& config) {
    if (config.insecure) return {};
    if (!config.xml.empty())
        return fail(std::string("/dds/xml: may lead plain DDS off loopback: expected ") + protection);
    if (is_loopback_address(config.interface) || is_loopback_interface(config.interface)) return {};
    const std::string chosen = config.interface.empty() ? "\"\": Cyclone DDS chooses the interface, which"
                                                        : "\"" + config.interface + "\"";
    return fail("/dds/interface: " + chosen + " is not loopback, and DDS is plain: expected " + protection);
}

}  // namespace

Result<std::optional<Identity>> check_protection(const config::Dds& config) {
    if (config.security.empty()) {
        const auto checked = check_exposure(config);
        if (!checked) return tl::unexpected(checked.error());
        return std::nullopt;
    }
    const std::string problem = wire::identity_problem(config.security);
    if (!problem.empty()) return fail("/dds/security: " + problem);
    const auto identity = read_identity(config.security);
    if (!identity) return fail("/dds/security: " + identity.error().message);
    return *identity;
}

Result<void> confine_to_loopback() {
    const std::string device = loopback_device();
    if (device.empty()) return fail(std::string("there is no loopback interface: expected ") + protection);
    for (int file = 0; file < FD_SETSIZE; ++file) {  // Cyclone DDS has none beyond
        if (!receives_from_anywhere(file)) continue;
        if (::setsockopt(file, SOL_SOCKET, SO_BINDTODEVICE, device.c_str(),
                         static_cast<socklen_t>(device.size())) != 0)
            return fail("cannot bind a socket of DDS to \"" + device + "\": " + std::strerror(errno) +
                        ": expected Linux 5.7, CAP_NET_RAW, " + protection);
    }
    return {};
}

}  // namespace camdir::dds
