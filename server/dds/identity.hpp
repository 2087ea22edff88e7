// What the files of an identity of DDS Security say.
#pragma once

#include <chrono>
#include <filesystem>

#include "base/error.hpp"

namespace camdir::dds {

struct Identity {
    std::chrono::system_clock::time_point expires;  // its certificate
};

// Reads the files of deploy/security/authority.sh and checks them as DDS does: the certificate is valid now,
// is not revoked, belongs to the key and is signed by the identity CA; governance and permissions are signed
// by the permissions CA. What these grant, only DDS checks. The error names the file and what to do.
[[nodiscard]] Result<Identity> read_identity(const std::filesystem::path& folder);

}  // namespace camdir::dds
