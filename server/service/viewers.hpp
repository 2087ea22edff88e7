// A broadcast as resources of HTTP.
#pragma once

#include <optional>
#include <string_view>

#include "http/server.hpp"
#include "recording/broadcast.hpp"

namespace camdir::service {

// For http::Sources::broadcast.
[[nodiscard]] std::optional<http::Resource> viewers_resource(const recording::Broadcast& broadcast,
                                                             std::string_view path);

}  // namespace camdir::service
