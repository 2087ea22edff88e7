// Colours and what they stand for.
#pragma once

#include <cstddef>

namespace camdir::render {

struct Colour {
    float red = 0.0F, green = 0.0F, blue = 0.0F;  // 0 .. 1, sRGB
};

[[nodiscard]] inline Colour operator*(const Colour& colour, float factor) {
    return {colour.red * factor, colour.green * factor, colour.blue * factor};
}
[[nodiscard]] inline Colour operator+(const Colour& a, const Colour& b) {
    return {a.red + b.red, a.green + b.green, a.blue + b.blue};
}

// A perceptually uniform scale (viridis): dark violet at 0 and below, yellow at 1 and above.
[[nodiscard]] Colour colour_scale(float value);

// Clearly different colours for player 0, 1, 2, ...; they repeat after 8.
[[nodiscard]] Colour player_colour(std::size_t player);

}  // namespace camdir::render
