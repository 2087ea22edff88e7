// Arbitrary bytes in names of files and paths of HTTP.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace camdir::recording {

// Every byte but letters, digits and _ becomes %XX.
[[nodiscard]] std::string percent_encoded(std::string_view text);

// Nothing: a % that two hexadecimal digits do not follow.
[[nodiscard]] std::optional<std::string> percent_decoded(std::string_view text);

}  // namespace camdir::recording
