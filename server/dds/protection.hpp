// Who may take part in the director's domain.
#pragma once

#include <optional>

#include "base/error.hpp"
#include "config/config.hpp"
#include "dds/identity.hpp"

namespace camdir::dds {

// The identity in config.security; nullopt where DDS is plain. Fails when it lacks a file, its key is open to
// everyone or read_identity() fails, and when DDS is plain but not bound to loopback and config.insecure does
// not allow that. The error begins with the key's JSON pointer.
[[nodiscard]] Result<std::optional<Identity>> check_protection(const config::Dds& config);

// Lets other hosts reach none of this process's UDP sockets: whichever interface Cyclone DDS sends on, it
// receives on all. Needs Linux 5.7, or CAP_NET_RAW. Call it when the domain is open, and no participant yet.
[[nodiscard]] Result<void> confine_to_loopback();

}  // namespace camdir::dds
