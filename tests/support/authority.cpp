#include "support/authority.hpp"

#include <stdexcept>

#include "support/child_process.hpp"

namespace camdir::test {

Authority::Authority() {
    run("create", {});
}

void Authority::run(const std::string& command, const std::vector<std::string>& arguments) const {
    std::vector<std::string> all = {CAMDIR_AUTHORITY, command, folder().string()};
    all.insert(all.end(), arguments.begin(), arguments.end());
    ChildProcess process(all);
    if (process.wait() != 0) throw std::runtime_error(process.errors());
}

std::filesystem::path Authority::issue(const std::string& name, const std::string& role,
                                       const std::string& matches) const {
    run("issue", {name, role, matches});
    return folder() / "identities" / name;
}

void Authority::certify(const std::filesystem::path& identity, const std::string& options) const {
    ChildProcess openssl({"/bin/bash", "-c",
                          "cd " + folder().string() + " && openssl req -new -config authority.conf -key " +
                              (identity / "key.pem").string() + " -subj /CN=" + identity.filename().string() +
                              " -out request && openssl ca -config authority.conf -batch -notext -in request "
                              "-out " +
                              (identity / "certificate.pem").string() + " " + options});
    if (openssl.wait() != 0) throw std::runtime_error(openssl.errors());
}

}  // namespace camdir::test
