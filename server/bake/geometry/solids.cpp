#include "bake/geometry/solids.hpp"

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

}  // namespace

Solids::Solids(const scene::Scene& scene) : scene_(scene), tree_(boxes_of_brushes(scene)) {}

bool Solids::contains(const Vec3d& point) const {
    return is_covered({point, point, point});
}

bool Solids::is_buried(const Triangle3d& t, double offset) const {
    const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if (!(normal.norm() > 0.0)) return false;
    const Vec3d up = offset * normal.normalized();
    return is_covered({t[0] + up, t[1] + up, t[2] + up}) && is_covered({t[0] - up, t[1] - up, t[2] - up});
}

bool Solids::is_covered(const Triangle3d& t) const {
    bool covered = false;
    const auto matters = [&](const Box3d& box) {
        return !covered && box.contains(t[0]) && box.contains(t[1]) && box.contains(t[2]);
    };
    tree_.visit_where(matters, [&](std::uint32_t position) {
        const scene::Brush& brush = scene_.brushes[tree_.order()[position]];
        covered = covered || std::all_of(t.begin(), t.end(),
                                         [&](const Vec3d& p) { return scene::contains(scene_, brush, p); });
    });
    return covered;
}

}  // namespace camdir::bake
