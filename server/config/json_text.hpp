// JSON text from outside, read with the checks that a parser leaves out.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/error.hpp"

namespace camdir::config {

// Parses strict JSON. Besides syntax (the error says line and column) it refuses objects that have a key
// twice, which readers resolve differently, and nesting deeper than any of the project's formats.
[[nodiscard]] Result<nlohmann::json> parse_json(const std::string& text);

}  // namespace camdir::config
