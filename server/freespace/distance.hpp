// Distance to the obstacles: the paper's section 5.1.
#pragma once

#include <limits>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

struct Distance {
    // A lower bound of the clearance of the point: the largest d_f(m) - |c - m| over the points m of
    // the slabs looked at. -infinity when the point is in none of them, and for a point that is not finite.
    float value = -std::numeric_limits<float>::infinity();
    // The slab that gave it: the tracking state for the next query. `none` when nothing covers the point.
    std::uint32_t triangle = none;

    [[nodiscard]] bool covered() const { return value > 0.0F; }
};

// The free distance at `point`. `previous` is the slab of the preceding point, which makes the query
// cheap when the point moved a little: it and its neighbours (sharing a vertex) are tried first; the
// spatial index takes over when they do not cover the point. Thread-safe, does not allocate.
[[nodiscard]] Distance distance(const Freespace& freespace, const Vec3f& point,
                                std::uint32_t previous = none);

// The largest free distance over all slabs, by the spatial index alone.
[[nodiscard]] Distance distance_everywhere(const Freespace& freespace, const Vec3f& point);

}  // namespace camdir::freespace
