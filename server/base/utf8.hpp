// Strings from outside, which may hold any bytes.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace camdir {

// The largest number of bytes up to `max` that ends between characters.
[[nodiscard]] std::size_t utf8_prefix(std::string_view text, std::size_t max);

// With a question mark for every byte that belongs to no character.
[[nodiscard]] std::string to_utf8(std::string_view text);

// For a terminal or a line of a log, which it can neither end nor command: the same, with a question mark for
// every control character too.
[[nodiscard]] std::string printable(std::string_view text);

}  // namespace camdir
