// JSON text: read with checks that a parser leaves out, and written.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/error.hpp"

namespace camdir::config {

// Parses strict JSON. Besides syntax errors (with line and column) it refuses objects with a duplicate key,
// which readers resolve differently, and nesting deeper than any of the project's formats.
[[nodiscard]] Result<nlohmann::json> parse_json(const std::string& text);

// Indented text that ends with a newline. Strings may hold any bytes, as names of files do: what is not UTF-8
// is replaced.
[[nodiscard]] std::string format_json(const nlohmann::ordered_json& value);

}  // namespace camdir::config
