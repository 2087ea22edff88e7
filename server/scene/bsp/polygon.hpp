// Convex polygons in space: clipping and triangulation.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

// Corners in order; empty: no polygon.
using Polygon = std::vector<Vec3d>;

// The same plane, with a normal of length 1.
[[nodiscard]] Plane normalized(const Plane& plane);

// The same plane, with the solid on its other side.
[[nodiscard]] Plane flipped(const Plane& plane);

// A square in `plane`, counter-clockwise seen from where the normal points, with its centre at the point
// of the plane nearest to the origin.
[[nodiscard]] Polygon base_winding(const Plane& plane, double half_side);

// All corners lie within `tolerance` of the plane.
[[nodiscard]] bool lies_on(const Polygon& polygon, const Plane& plane, double tolerance);

// The part behind the plane (normal.dot(p) <= distance). Corners within `tolerance` count as on the plane;
// empty when no corner is further behind it than that.
[[nodiscard]] Polygon clip(const Polygon& polygon, const Plane& plane, double tolerance);

// The part inside the box.
[[nodiscard]] Polygon clip_to_box(Polygon polygon, const Box3d& box);

// Indices into `polygon` of triangles that cover it: a zigzag that takes the shorter diagonal each time.
[[nodiscard]] std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon);

}  // namespace camdir::scene
