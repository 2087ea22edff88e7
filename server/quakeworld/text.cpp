#include "quakeworld/text.hpp"

#include <algorithm>

namespace camdir::quakeworld {
namespace {

// The high half of the character set is the low half in another colour; 16 to 27 are golden brackets and
// digits.
char plain(char sign) {
    const auto code = static_cast<unsigned char>(static_cast<unsigned char>(sign) & 127U);
    if (code >= 32 && code < 127) return static_cast<char>(code);
    if (code == 16) return '[';
    if (code == 17) return ']';
    if (code >= 18 && code <= 27) return static_cast<char>('0' + code - 18);
    if (code == 5 || code == 14 || code == 15 || code == 28) return '.';
    return '?';
}

// Takes what stands before the next backslash out of `rest`, and the backslash.
std::string_view take_part(std::string_view& rest) {
    const std::string_view part = rest.substr(0, rest.find('\\'));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    return part;
}

}  // namespace

std::string plain(std::string_view text) {
    std::string ascii;
    ascii.reserve(text.size());
    for (const char sign : text)
        ascii += plain(sign);
    return ascii;
}

std::string plain_lines(std::string_view text) {
    std::string ascii = plain(text);
    for (std::size_t i = 0; i < text.size(); ++i)
        if ((static_cast<unsigned char>(text[i]) & 127U) == '\n') ascii[i] = '\n';
    return ascii;
}

std::string_view value_of(std::string_view info, std::string_view key) {
    take_part(info);
    while (!info.empty()) {
        const std::string_view name = take_part(info);
        const std::string_view value = take_part(info);
        if (name == key) return value;
    }
    return {};
}

}  // namespace camdir::quakeworld
