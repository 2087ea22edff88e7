#include "idl/security.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>

namespace camdir::wire {
namespace {

struct File {
    const char* property;
    const char* name;
};

constexpr const char* key_file = "key.pem";
constexpr std::array<File, 7> files = {{
    {"dds.sec.auth.identity_ca", "identity_ca.pem"},
    {"dds.sec.auth.identity_certificate", "certificate.pem"},
    {"dds.sec.auth.private_key", key_file},
    {"org.eclipse.cyclonedds.sec.auth.crl", "revoked.pem"},
    {"dds.sec.access.permissions_ca", "permissions_ca.pem"},
    {"dds.sec.access.governance", "governance.p7s"},
    {"dds.sec.access.permissions", "permissions.p7s"},
}};

// The plugins of Cyclone DDS.
constexpr std::array<File, 9> plugins = {{
    {"dds.sec.auth.library.path", "dds_security_auth"},
    {"dds.sec.auth.library.init", "init_authentication"},
    {"dds.sec.auth.library.finalize", "finalize_authentication"},
    {"dds.sec.crypto.library.path", "dds_security_crypto"},
    {"dds.sec.crypto.library.init", "init_crypto"},
    {"dds.sec.crypto.library.finalize", "finalize_crypto"},
    {"dds.sec.access.library.path", "dds_security_ac"},
    {"dds.sec.access.library.init", "init_access_control"},
    {"dds.sec.access.library.finalize", "finalize_access_control"},
}};

std::string file_problem(const std::string& file, bool secret) {
    struct stat found {};
    if (::stat(file.c_str(), &found) != 0 || ::access(file.c_str(), R_OK) != 0)
        return file + ": cannot be read: " + std::strerror(errno) +
               ": expected a file of an identity that authority.sh has made";
    if (!S_ISREG(found.st_mode) || found.st_size == 0)
        return file + ": is empty or no file: expected one of an identity that authority.sh has made";
    if (secret && (found.st_mode & S_IRWXO) != 0)
        return file +
               ": is open to everyone: expected a key that only the owner and group can read: chmod o-rwx";
    return {};
}

}  // namespace

std::string identity_problem(const std::string& folder) {
    for (const auto& [property, name] : files) {
        std::string problem = file_problem(folder + "/" + name, name == key_file);
        if (!problem.empty()) return problem;
    }
    return {};
}

Qos participant_qos(const std::string& folder) {
    Qos qos(dds_create_qos());
    if (!qos) throw std::bad_alloc();
    if (folder.empty()) return qos;
    for (const auto& [property, name] : plugins)
        dds_qset_prop(qos.get(), property, name);
    for (const auto& [property, name] : files)
        dds_qset_prop(qos.get(), property, ("file:" + folder + "/" + name).c_str());
    return qos;
}

std::string describe_failure(dds_return_t code) {
    const std::string text = dds_strretcode(code);
    return code == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY
               ? text + ": expected an identity whose role and matches include it"
               : text;
}

}  // namespace camdir::wire
