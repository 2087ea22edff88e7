#include "scene/q3_brushes.hpp"

#include <span>
#include <utility>

#include "scene/q3_tree.hpp"

namespace camdir::scene::q3 {
namespace {

// Larger than any map: coordinates are below 2^20.
constexpr double half_side = 1 << 22;
// Above the rounding of cuts at that size in double precision, far below that of the file's float planes.
constexpr double tolerance = 1e-6;

std::vector<scene::Plane> planes_of(const Bsp& bsp, const Brush& brush, const Vec3d& translation) {
    std::vector<scene::Plane> planes;
    const auto sides =
        std::span(bsp.brush_sides)
            .subspan(static_cast<std::size_t>(brush.first_side), static_cast<std::size_t>(brush.side_count));
    for (const BrushSide& side : sides) {
        scene::Plane plane = to_plane(bsp.planes[static_cast<std::size_t>(side.plane)]);
        plane.distance += plane.normal.dot(translation);
        planes.push_back(plane);
    }
    return planes;
}

// What the other half spaces leave of a side. Of sides in the same plane only the first has a face.
Polygon face_of(const std::vector<scene::Plane>& planes, std::size_t side) {
    Polygon face = square_on(planes[side], half_side);
    for (std::size_t other = 0; other < planes.size() && !face.empty(); ++other) {
        if (other == side) continue;
        if (!lies_on(face, planes[other], tolerance))
            face = cut_behind(face, planes[other], tolerance);
        else if (other < side)
            face.clear();
    }
    return face;
}

}  // namespace

Solid make_solid(const Bsp& bsp, const Brush& brush, const Vec3d& translation) {
    Solid solid;
    solid.planes = planes_of(bsp, brush, translation);
    for (std::size_t side = 0; side < solid.planes.size(); ++side) {
        Polygon face = face_of(solid.planes, side);
        if (face.empty()) continue;
        for (const Vec3d& corner : face) {
            solid.bounds.extend(corner);
        }
        solid.faces.push_back({std::move(face), solid.planes[side].normal});
    }
    return solid;
}

}  // namespace camdir::scene::q3
