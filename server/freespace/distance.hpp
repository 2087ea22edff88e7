// Distance to the obstacles: the paper's section 5.1.
#pragma once

#include <limits>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

// The share of a ball's radius within which a point is free whatever the rounding.
inline constexpr float surely_inside = 0.9F;

struct Distance {
    // A lower bound of the clearance of the point: the largest d_f(m) - |c - m| over the points m of all
    // slabs, but for a rounding of 1e-6 of the map's size. -infinity when the point is in no slab, and for a
    // point that is not finite.
    float value = -std::numeric_limits<float>::infinity();
    // The slab that gave it: none when nothing covers the point.
    std::uint32_t triangle = none;

    [[nodiscard]] bool covered() const { return value > 0.0F; }
};

// The free distance at `point`: the octree lists the few slabs that can give the largest there. Thread-safe;
// may make the octree.
[[nodiscard]] Distance distance(const Freespace& freespace, const Vec3f& point);

}  // namespace camdir::freespace
