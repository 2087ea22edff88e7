#include "bake/geometry/obstacles.hpp"

namespace camdir::bake {
namespace {

// A cloud's obstacles are points: triangles without extent.
std::size_t obstacle_count(const scene::Scene& scene) {
    return scene.points.empty() ? scene.triangles.size() : scene.points.size();
}

Triangle3d obstacle_at(const scene::Scene& scene, std::size_t index) {
    if (!scene.points.empty()) return {scene.points[index], scene.points[index], scene.points[index]};
    return scene::corners(scene, index);
}

std::vector<Box3d> boxes_of_obstacles(const scene::Scene& scene) {
    std::vector<Box3d> boxes(obstacle_count(scene));
    for (std::size_t i = 0; i < boxes.size(); ++i)
        boxes[i] = box_of(obstacle_at(scene, i));
    return boxes;
}

}  // namespace

Obstacles::Obstacles(const scene::Scene& scene) : tree_(boxes_of_obstacles(scene)) {
    triangles_.reserve(obstacle_count(scene));
    for (const std::uint32_t index : tree_.order())
        triangles_.push_back(obstacle_at(scene, index));
}

std::optional<Vec3d> Obstacles::nearest(const Vec3d& point, double within) const {
    double nearest2 = within * within;
    std::optional<Vec3d> nearest;
    tree_.visit_by([&](const Box3d& box) { return box.squaredExteriorDistance(point); },
                   [&] { return nearest2; },
                   [&](std::uint32_t position) {
                       const Vec3d q = closest_point(triangles_[position], point);
                       const double distance2 = (q - point).squaredNorm();
                       if (distance2 >= nearest2) return;
                       nearest2 = distance2;
                       nearest = q;
                   });
    return nearest;
}

double Obstacles::distance(const Vec3d& point, double at_most) const {
    const std::optional<Vec3d> q = nearest(point, at_most);
    return q ? (*q - point).norm() : at_most;
}

}  // namespace camdir::bake
