// Text for HTML and for a shell.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace camdir::report {

// As text or as an attribute's value in quotation marks; bytes that are no UTF-8 become question marks.
[[nodiscard]] std::string escape(std::string_view text);

// data:image/png;base64,...
[[nodiscard]] std::string png_uri(std::span<const std::byte> png);

// One word of a POSIX shell, in quotation marks where it needs them.
[[nodiscard]] std::string shell_word(std::string_view text);

// At most `decimals` digits behind the point, without trailing zeros; never with an exponent.
[[nodiscard]] std::string decimal(double value, int decimals);

}  // namespace camdir::report
