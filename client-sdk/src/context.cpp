#include "context.hpp"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <mutex>
#include <system_error>

#include "entity.hpp"
#include "idl/security.hpp"
#include "network.hpp"

namespace camdir::sdk {

namespace {

struct OpenDomain {
    std::string configuration, identity;
    Entity entity;  // empty when the application has joined the domain itself
    int shares = 0;
};

struct OpenDomains {
    std::mutex mutex;
    std::map<std::uint32_t, OpenDomain> by_number;
};

// Never destroyed: contexts may be closed while the process exits.
OpenDomains& open_domains() {
    static auto* domains = new OpenDomains;
    return *domains;
}

// Empty: none.
std::string identity_of(const cdir_context_options& options) {
    return options.security != nullptr ? options.security : "";
}

// Cyclone DDS waits with select(), which aborts the process on a descriptor from 1024 on.
void check_file_descriptors() {
    constexpr int limit = 1000;
    const int lowest_free = eventfd(0, EFD_CLOEXEC);
    const int error = errno;
    if (lowest_free >= 0) close(lowest_free);
    if (lowest_free >= limit || (lowest_free < 0 && error == EMFILE)) {
        throw Failure{CDIR_CONFLICT,
                      "the process holds too many file descriptors: a context needs some below 1000"};
    }
    if (lowest_free < 0)
        throw Failure{CDIR_OUT_OF_MEMORY,
                      "cannot get a file descriptor: " + std::generic_category().message(error)};
}

Entity join(const cdir_context_options& options, const std::string& configuration) {
    check_file_descriptors();
    const dds_entity_t created = dds_create_domain(options.domain, configuration.c_str());
    if (created == DDS_RETCODE_PRECONDITION_NOT_MET) return {};  // by the application
    const std::string how = options.cyclone_xml != nullptr ? "with this cyclone_xml"
                                                           : "through network interface '" +
                                                                 std::string(options.network_interface) + "'";
    Entity domain("cannot join DDS domain " + std::to_string(options.domain) + " " + how, created);
    require_known_director(options);
    return domain;
}

Entity create_participant(const cdir_context_options& options) {
    const std::string identity = identity_of(options);
    const std::string with =
        identity.empty() ? "" : " with the identity in " + identity + " (Cyclone DDS has logged why not)";
    return {"cannot create a participant in DDS domain " + std::to_string(options.domain) + with,
            dds_create_participant(options.domain, wire::participant_qos(identity).get(), nullptr)};
}

}  // namespace

DomainShare::DomainShare(const cdir_context_options& options) : domain_(options.domain) {
    const std::uint32_t domain = options.domain;
    const std::string configuration = network_configuration(options);
    OpenDomains& domains = open_domains();
    const std::lock_guard lock(domains.mutex);
    auto found = domains.by_number.find(domain);
    if (found == domains.by_number.end()) {
        OpenDomain joined{configuration, identity_of(options), join(options, configuration), 0};
        found = domains.by_number.emplace(domain, std::move(joined)).first;
    } else if (found->second.configuration != configuration) {
        throw Failure{CDIR_CONFLICT, "domain " + std::to_string(domain) +
                                         " is already open in this process with other network settings"};
    } else if (found->second.identity != identity_of(options)) {
        // Cyclone DDS would give it the permissions of the first one.
        throw Failure{CDIR_CONFLICT, "domain " + std::to_string(domain) +
                                         " is already open in this process with another identity (security)"};
    }
    ++found->second.shares;
}

DomainShare::~DomainShare() {
    OpenDomains& domains = open_domains();
    const std::lock_guard lock(domains.mutex);
    const auto found = domains.by_number.find(domain_);
    if (--found->second.shares == 0) domains.by_number.erase(found);
}

// Of the strings, only those that are used need not be null.
OwnedOptions::OwnedOptions(const cdir_context_options& options) : options_(options) {
    if (options.network_interface != nullptr) network_interface_ = options.network_interface;
    if (options.directors != nullptr) directors_ = options.directors;
    if (options.cyclone_xml != nullptr) cyclone_xml_ = options.cyclone_xml;
    if (options.security != nullptr) security_ = options.security;
}

cdir_context_options OwnedOptions::get() const {
    cdir_context_options options = options_;
    options.network_interface = network_interface_.c_str();
    options.directors = directors_.c_str();
    if (options_.cyclone_xml != nullptr) options.cyclone_xml = cyclone_xml_.c_str();
    if (options_.security != nullptr) options.security = security_.c_str();
    return options;
}

Context::Context(const cdir_context_options& options)
    : domain_(options), participant_(create_participant(options)), topics_(participant_.get()) {}

}  // namespace camdir::sdk
