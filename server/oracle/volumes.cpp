#include "oracle/volumes.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace camdir::oracle {

Volumes::Volumes(RTCDevice device, const scene::Scene& scene)
    : planes_(scene.planes), brushes_(scene.brushes) {
    if (brushes_.empty()) return;
    scene_ = make_scene(device, brushes_.size(), [this](std::size_t i) { return brushes_[i].bounds; });
}

double Volumes::depth(const Vec3d& point) const {
    double deepest = -std::numeric_limits<double>::infinity();
    if (!scene_) return deepest;
    visit_near(scene_.get(), point, 0.0, [&](unsigned brush, double&) {
        deepest = std::max(deepest, depth_in(brushes_[brush], point));
    });
    return deepest;
}

bool Volumes::ball_clear(const Vec3d& centre, double radius) const {
    bool clear = true;
    if (!scene_) return clear;
    visit_near(scene_.get(), centre, radius, [&](unsigned brush, double& search) {
        if (depth_in(brushes_[brush], centre) < -radius) return;
        clear = false;
        search = 0.0;
    });
    return clear;
}

double Volumes::depth_in(const scene::Brush& brush, const Vec3d& point) const {
    double depth = std::numeric_limits<double>::infinity();
    for (const scene::Plane& plane : std::span(planes_).subspan(brush.first_plane, brush.plane_count)) {
        depth = std::min(depth, plane.distance - plane.normal.dot(point));
    }
    return depth;
}

}  // namespace camdir::oracle
