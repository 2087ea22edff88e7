// The Cyclone DDS configuration that a context's options amount to.
#pragma once

#include <camera_director/camera_director.h>

#include <string>

namespace camdir::sdk {

// XML. Hub and spoke: this process announces itself to the directors only, and they answer.
// Throws Failure when an address or the interface's name holds what such a name cannot.
[[nodiscard]] std::string network_configuration(const cdir_context_options& options);

}  // namespace camdir::sdk
