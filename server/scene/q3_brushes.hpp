// Brushes: from half spaces to faces.
#pragma once

#include <vector>

#include "scene/polygon.hpp"
#include "scene/q3_bsp.hpp"

namespace camdir::scene::q3 {

struct BrushFace {
    Polygon polygon;  // counter-clockwise seen from outside
    Vec3d normal;     // outwards
};

struct Solid {
    std::vector<scene::Plane> planes;  // of all sides
    std::vector<BrushFace> faces;      // of the sides that bound the solid; empty when it has no volume
    Box3d bounds;
};

// Convex hull of the brush's half spaces, moved by `translation`.
[[nodiscard]] Solid make_solid(const Bsp& bsp, const Brush& brush, const Vec3d& translation);

}  // namespace camdir::scene::q3
