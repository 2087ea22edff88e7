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

}  // namespace camdir::test
