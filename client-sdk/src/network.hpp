// The Cyclone DDS configuration for a context's options.
#pragma once

#include <camera_director/camera_director.h>

#include <string>

namespace camdir::sdk {

// XML. This process announces itself to the directors only, and they answer.
// Throws a Failure with CDIR_INVALID_ARGUMENT when an address or the interface's name has characters that are
// not allowed there.
[[nodiscard]] std::string network_configuration(const cdir_context_options& options);

// Throws a Failure with CDIR_NETWORK when no director's address can be resolved, which Cyclone DDS only
// reports on standard error. May wait for a name server. Not with cyclone_xml.
void require_known_director(const cdir_context_options& options);

}  // namespace camdir::sdk
