#include "oracle/volumes.hpp"

#include <algorithm>
#include <limits>
#include <span>

namespace camdir::oracle {
namespace {

void bounds_of_brush(const RTCBoundsFunctionArguments* arguments) {
    const auto& brushes = *static_cast<const std::vector<scene::Brush>*>(arguments->geometryUserPtr);
    const Box3d& box = brushes[arguments->primID].bounds;
    const double margin =
        rounding_of(std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff()));
    RTCBounds& bounds = *arguments->bounds_o;
    bounds.lower_x = static_cast<float>(box.min().x() - margin);
    bounds.lower_y = static_cast<float>(box.min().y() - margin);
    bounds.lower_z = static_cast<float>(box.min().z() - margin);
    bounds.upper_x = static_cast<float>(box.max().x() + margin);
    bounds.upper_y = static_cast<float>(box.max().y() + margin);
    bounds.upper_z = static_cast<float>(box.max().z() + margin);
}

}  // namespace

Volumes::Volumes(RTCDevice device, const scene::Scene& scene)
    : planes_(scene.planes), brushes_(scene.brushes) {
    if (brushes_.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(brushes_.size()));
    rtcSetGeometryUserData(geometry, &brushes_);
    rtcSetGeometryBoundsFunction(geometry, bounds_of_brush, nullptr);
    scene_ = make_scene(device, geometry);
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
