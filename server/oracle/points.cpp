#include "oracle/points.hpp"

#include <cmath>
#include <limits>

namespace camdir::oracle {
namespace {

void bounds_of_point(const RTCBoundsFunctionArguments* arguments) {
    const auto& points = *static_cast<const std::vector<Vec3d>*>(arguments->geometryUserPtr);
    const Vec3d& point = points[arguments->primID];
    const double margin = rounding_of(point.cwiseAbs().maxCoeff());
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = static_cast<float>(point.x() - margin);
    bounds.lower_y = static_cast<float>(point.y() - margin);
    bounds.lower_z = static_cast<float>(point.z() - margin);
    bounds.upper_x = static_cast<float>(point.x() + margin);
    bounds.upper_y = static_cast<float>(point.y() + margin);
    bounds.upper_z = static_cast<float>(point.z() + margin);
}

}  // namespace

Points::Points(RTCDevice device, const scene::Scene& scene, double radius)
    : points_(scene.points), radius_(radius) {
    if (points_.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(points_.size()));
    rtcSetGeometryUserData(geometry, &points_);
    rtcSetGeometryBoundsFunction(geometry, bounds_of_point, nullptr);
    scene_ = make_scene(device, geometry);
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
