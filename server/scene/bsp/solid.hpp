// Convex solids: from half spaces to faces.
#pragma once

#include <vector>

#include "scene/bsp/polygon.hpp"

namespace camdir::scene {

struct SolidFace {
    Polygon polygon;  // counter-clockwise seen from outside
    Vec3d normal;     // outwards
};

struct Solid {
    std::vector<Plane> planes;     // of all sides
    std::vector<SolidFace> faces;  // of the sides that bound the solid; empty when it has no volume
    Box3d bounds;
};

// The intersection of the half spaces; coordinates must be below 2^20 in size.
[[nodiscard]] Solid make_solid(std::vector<Plane> planes);

// A box as a solid: six planes, six faces in the same order.
[[nodiscard]] Solid make_solid(const Box3d& box);

// The part of `solid` behind the plane. Every plane of `solid` must have its face, in the same order; the
// result has the same property, and no planes when nothing is left.
[[nodiscard]] Solid clip(const Solid& solid, const Plane& plane);

// Its half spaces, of its faces alone. There must be some.
[[nodiscard]] ConvexPart convex_part(const Solid& solid);

[[nodiscard]] double area(const Polygon& polygon);

}  // namespace camdir::scene
