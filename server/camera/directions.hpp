// The directions from which a player could be seen.
#pragma once

#include <array>

#include "camera/view.hpp"

namespace camdir::camera {

// A world-fixed grid of directions from the player's eye: 24 yaws of 15 degrees, 8 elevations from -45 to 60.
struct DirectionGrid {
    static constexpr std::size_t yaws = 24;
    static constexpr std::size_t elevations = 8;
    static constexpr std::size_t size = yaws * elevations;
    static constexpr float spacing = 15.0F * radians_of_a_degree<float>;
    static constexpr float lowest = -45.0F * radians_of_a_degree<float>;

    [[nodiscard]] static Look look(std::size_t bin) {
        return {static_cast<float>(bin % yaws) * spacing, lowest + static_cast<float>(bin / yaws) * spacing};
    }
    // Unit vectors from the eye to the camera, by bin.
    [[nodiscard]] static const std::array<Vec3f, size>& directions();
};

}  // namespace camdir::camera
