// Checks of shapes that come from outside.
#pragma once

#include <optional>
#include <span>

#include "freespace/mover_shape.hpp"

namespace camdir::freespace {

// The box around the intersection of the half spaces, whose numbers are finite and whose normals have length
// 1; nothing where there are fewer than 4, or the intersection is empty, unbounded, or reaches farther than
// 1e6 units. Takes up to 1 ms for 64 of them.
[[nodiscard]] std::optional<Box3f> bounds_of(std::span<const HalfSpace> half_spaces);

// Its numbers are finite and within the limit of coordinates, and its radius is positive.
[[nodiscard]] bool is_ball(const MoverBall& ball);

}  // namespace camdir::freespace
