#include "render/colour.hpp"

#include <algorithm>
#include <array>

namespace camdir::render {

Colour colour_scale(float value) {
    // Samples of matplotlib's viridis map, which is in the public domain.
    constexpr std::array<Colour, 11> samples{{{0.267F, 0.005F, 0.329F},
                                              {0.283F, 0.141F, 0.458F},
                                              {0.254F, 0.265F, 0.530F},
                                              {0.207F, 0.372F, 0.553F},
                                              {0.164F, 0.471F, 0.558F},
                                              {0.128F, 0.567F, 0.551F},
                                              {0.135F, 0.659F, 0.518F},
                                              {0.267F, 0.749F, 0.441F},
                                              {0.478F, 0.821F, 0.318F},
                                              {0.741F, 0.873F, 0.150F},
                                              {0.993F, 0.906F, 0.144F}}};
    const float place = std::clamp(value, 0.0F, 1.0F) * static_cast<float>(samples.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), samples.size() - 2);
    const float share = place - static_cast<float>(below);
    return samples[below] * (1.0F - share) + samples[below + 1] * share;
}

Colour player_colour(std::size_t player) {
    constexpr std::array<Colour, 8> colours{{{0.90F, 0.10F, 0.15F},
                                             {0.00F, 0.45F, 0.85F},
                                             {0.95F, 0.55F, 0.00F},
                                             {0.10F, 0.60F, 0.20F},
                                             {0.60F, 0.15F, 0.70F},
                                             {0.00F, 0.65F, 0.70F},
                                             {0.85F, 0.30F, 0.60F},
                                             {0.45F, 0.30F, 0.15F}}};
    return colours[player % colours.size()];
}

}  // namespace camdir::render
