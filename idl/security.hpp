// DDS Security: a participant that is an identity which deploy/security/authority.sh has made, for the server
// and the client library.
#pragma once

#include <string>

#include "idl/topics.hpp"

namespace camdir::wire {

// Whether `folder` has all files of an identity, and its key is not open to everyone. Empty, or what is wrong
// with which file and what was expected. What the files say, only DDS checks.
[[nodiscard]] std::string identity_problem(const std::string& folder);

// For a participant with this identity; plain DDS when `folder` is empty. Throws std::bad_alloc.
[[nodiscard]] Qos participant_qos(const std::string& folder);

// What DDS says of a call that has failed with this code, and why where it is for the identity.
[[nodiscard]] std::string describe_failure(dds_return_t code);

}  // namespace camdir::wire
