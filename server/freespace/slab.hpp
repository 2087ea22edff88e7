// The best point of a slab for a query point: the m of a triangle that maximises r(m) - |c - m|.
//
// r is linear on the triangle, so the function is concave: its maximum over the triangle's plane has a closed
// form (the foot of c, moved uphill by h g / sqrt(1 - g^2), where h is the height of c and g the gradient of
// r), and when that lies outside the triangle the maximum is on an edge, where the same form holds in one
// dimension. The paper's nearest point (section 5.1) is the special case of constant r.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

// A point of a triangle's slab: m = a + u (b - a) + v (c - a).
struct SlabPoint {
    float value = -std::numeric_limits<float>::infinity();  // r(m) - |c - m|, rounded
    std::uint32_t triangle = none;
    float u = 0.0F;
    float v = 0.0F;
};

// The start of a search: only slabs that contain the point improve it.
inline constexpr SlabPoint uncovered{.value = 0.0F};

// Replaces `best` by the best point of triangles first .. first + count - 1 if its value is larger.
void improve_range(const MeshView& mesh, const Vec3f& point, std::uint32_t first, std::uint32_t count,
                   SlabPoint& best);

// The ball around a slab's point, in double precision: it lies in the slab.
struct Ball {
    Vec3d centre;
    double radius;
};
[[nodiscard]] Ball ball_at(const MeshView& mesh, const SlabPoint& point);
// The same where a, b, c are the given corners of the point's triangle.
[[nodiscard]] Ball ball_at(std::span<const Vertex> vertices, const Triangle& corners, const SlabPoint& point);

}  // namespace camdir::freespace
