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

// U+0000 to U+001F and U+007F to U+009F.
bool is_control(std::string_view character) {
    if (character.size() == 1) return at(character, 0) < 0x20 || at(character, 0) == 0x7f;
    return at(character, 0) == 0xc2 && at(character, 1) < 0xa0;
}

// In place of every byte that belongs to no character, and of unwanted characters.
template <class Unwanted>
std::string with_question_marks(std::string_view text, Unwanted unwanted) {
    std::string wanted;
    while (!text.empty()) {
        const std::size_t length = first_character(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
        if (length == 0 || unwanted(character))
            wanted += '?';
        else
            wanted += character;
        text.remove_prefix(character.size());
    }
    return wanted;
}

}  // namespace

std::size_t utf8_prefix(std::string_view text, std::size_t max) {
    std::size_t length = std::min(text.size(), max);
    while (length > 0 && continues(text, length))
        --length;
    return length;
}

std::string to_utf8(std::string_view text) {
    return with_question_marks(text, [](std::string_view) { return false; });
}

std::string printable(std::string_view text) {
    return with_question_marks(text, is_control);
}

}  // namespace camdir
