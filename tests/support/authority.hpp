// An authority of DDS Security.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace camdir::test {

// Of deploy/security/authority.sh, in a temporary folder.
class Authority {
  public:
    Authority();

    // Runs a command with these arguments behind the folder; throws when it fails.
    void run(const std::string& command, const std::vector<std::string>& arguments) const;
    // The folder of a new identity.
    std::filesystem::path issue(const std::string& name, const std::string& role,
                                const std::string& matches) const;
    // Replaces the certificate of that identity by another for its key, with these options of `openssl ca`,
    // such as -enddate; throws when it fails.
    void certify(const std::filesystem::path& identity, const std::string& options) const;
    [[nodiscard]] std::filesystem::path folder() const { return folder_ / "authority"; }

  private:
    TemporaryFolder folder_;
};

}  // namespace camdir::test
