// The Cyclone DDS configuration for a context's options.
#pragma once

#include <camera_director/camera_director.h>

#include <string>

namespace camdir::sdk {

// XML. This process announces itself to the directors only, and they answer.
// Throws a Failure with CDIR_INVALID_ARGUMENT when an address or the interface's name has characters that are
// not allowed there.
[[nodiscard]] std::string network_configuration(const cdir_context_options& options);

}  // namespace camdir::sdk
