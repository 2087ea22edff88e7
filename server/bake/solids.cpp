#include "bake/solids.hpp"

#include <algorithm>

namespace camdir::bake {
namespace {

std::vector<Box3d> boxes_of_brushes(const scene::Scene& scene) {
    std::vector<Box3d> boxes;
    boxes.reserve(scene.brushes.size());
    for (const scene::Brush& brush : scene.brushes)
        boxes.push_back(brush.bounds);
    return boxes;
}

bool contains(const scene::Scene& scene, const scene::Brush& brush, const Vec3d& point) {
    const auto first = scene.planes.begin() + brush.first_plane;
    return std::all_of(first, first + brush.plane_count,
                       [&](const scene::Plane& plane) { return plane.normal.dot(point) <= plane.distance; });
}

}  // namespace

Solids::Solids(const scene::Scene& scene) : scene_(scene), tree_(boxes_of_brushes(scene)) {}

bool Solids::contain(const Vec3d& point) const {
    bool inside = false;
    tree_.visit_where([&](const Box3d& box) { return !inside && box.contains(point); },
                      [&](std::uint32_t position) {
                          inside = inside || contains(scene_, scene_.brushes[tree_.order()[position]], point);
                      });
    return inside;
}

}  // namespace camdir::bake
