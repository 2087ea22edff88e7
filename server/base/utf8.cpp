#include "base/utf8.hpp"

#include <algorithm>

namespace camdir {
namespace {

unsigned at(std::string_view text, std::size_t place) {
    return static_cast<unsigned char>(text[place]);
}

bool continues(std::string_view text, std::size_t place) {
    return place < text.size() && (at(text, place) & 0xc0U) == 0x80U;
}

// Neither an overlong form, nor a surrogate, nor beyond U+10FFFF: the second byte decides.
bool may_follow(unsigned first, unsigned second) {
    switch (first) {
        case 0xe0:
            return second >= 0xa0;
        case 0xed:
            return second < 0xa0;
        case 0xf0:
            return second >= 0x90;
        case 0xf4:
            return second < 0x90;
        default:
            return true;
    }
}

// Bytes of the character at the start of the text; 0: there is none.
std::size_t first_character(std::string_view text) {
    const unsigned first = at(text, 0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                               : first >= 0xe0 && first < 0xf0 ? 3
                               : first >= 0xf0 && first < 0xf5 ? 4
                                                               : 0;
    for (std::size_t i = 1; i < length; ++i)
        if (!continues(text, i)) return 0;
    return length > 0 && may_follow(first, at(text, 1)) ? length : 0;
}

}  // namespace

std::size_t utf8_prefix(std::string_view text, std::size_t max) {
    std::size_t length = std::min(text.size(), max);
    while (length > 0 && continues(text, length))
        --length;
    return length;
}

std::string to_utf8(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const std::size_t length = first_character(text);
        if (length == 0)
            valid += '?';
        else
            valid += text.substr(0, length);
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return valid;
}

}  // namespace camdir
