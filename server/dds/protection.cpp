#include "dds/protection.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>

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

bool is_loopback_interface(const std::string& name) {
    ifaddrs* found = nullptr;
    if (::getifaddrs(&found) != 0) return false;
    const std::unique_ptr<ifaddrs, decltype(&::freeifaddrs)> list(found, ::freeifaddrs);
    for (const ifaddrs* each = list.get(); each != nullptr; each = each->ifa_next)
        if (name == each->ifa_name) return (each->ifa_flags & IFF_LOOPBACK) != 0;
    return false;
}

constexpr const char* expected_protection =
    ": expected DDS Security (/dds/security names the folder of an identity), or \"insecure\": true in /dds "
    "where strangers do not reach the network";

Result<void> check_exposure(const config::Dds& config) {
    if (config.insecure) return {};
    if (!config.xml.empty())
        return fail(std::string("/dds/xml: may lead plain DDS off loopback") + expected_protection);
    if (is_loopback_address(config.interface) || is_loopback_interface(config.interface)) return {};
    const std::string chosen = config.interface.empty() ? "\"\": Cyclone DDS chooses the interface, which"
                                                        : "\"" + config.interface + "\"";
    return fail("/dds/interface: " + chosen + " is not loopback, and DDS is plain" + expected_protection);
}

}  // namespace

Result<void> check_protection(const config::Dds& config) {
    if (config.security.empty()) return check_exposure(config);
    const std::string problem = wire::identity_problem(config.security);
    if (!problem.empty()) return fail("/dds/security: " + problem);
    return {};
}

}  // namespace camdir::dds
