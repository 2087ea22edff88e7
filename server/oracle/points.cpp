#include "oracle/points.hpp"

#include <cmath>
#include <limits>

namespace camdir::oracle {

Points::Points(RTCDevice device, const scene::Scene& scene, double radius)
    : points_(scene.points), radius_(radius) {
    if (points_.empty()) return;
    scene_ = make_scene(device, points_.size(), [this](std::size_t i) { return Box3d(points_[i]); });
}

Nearest Points::nearest(const Vec3d& point, double limit) const {
    Nearest nearest{std::numeric_limits<double>::infinity(), Vec3d::Zero()};
    if (!scene_) return nearest;
    visit_near(scene_.get(), point, limit + radius_, [&](unsigned index, double& search) {
        const double distance = (points_[index] - point).norm() - radius_;
        if (distance > limit || distance >= nearest.distance) return;
        nearest = {distance, points_[index]};
        search = distance + radius_;
    });
    return nearest;
}

bool Points::segment_clear(const Vec3d& from, const Vec3d& to) const {
    const Vec3d way = to - from;
    const double length = way.norm();
    const double touch = radius_ / 1000.0;
    for (double done = 0.0;;) {
        const Vec3d place = from + way * (length > 0.0 ? done / length : 0.0);
        const double free = nearest(place, length - done + touch).distance;
        if (free <= touch) return false;
        if (done >= length) return true;
        done = std::min(done + free, length);
    }
}

}  // namespace camdir::oracle
