// Embree's handles, owned; its scenes, and what their rounding to float costs.
#pragma once

#include <embree3/rtcore.h>

#include <functional>
#include <memory>

#include "base/geometry.hpp"

namespace camdir::oracle {

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using Device = std::unique_ptr<RTCDeviceTy, ReleaseDevice>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseScene>;

[[nodiscard]] Device make_device();

// A robust, high-quality scene of this one geometry; takes it over.
[[nodiscard]] EmbreeScene make_scene(RTCDevice device, RTCGeometry geometry);

// The same of `count` primitives that Embree knows only by their boxes, for visit_near(). `box_of` is not
// called after the return.
[[nodiscard]] EmbreeScene make_scene(RTCDevice device, std::size_t count,
                                     const std::function<Box3d(std::size_t)>& box_of);

// How far the rounding to float may move a point, a box or a distance, when no coordinate is larger than
// `coordinate`.
[[nodiscard]] inline double rounding_of(double coordinate) {
    return coordinate * 0x1p-21;
}

// Calls visit(primitive, radius) for every primitive whose box meets the ball; visit may lower the radius.
template <class Visit>
void visit_near(RTCScene scene, const Vec3d& centre, double radius, Visit&& visit) {
    const double margin = rounding_of(centre.cwiseAbs().maxCoeff());
    RTCPointQuery query;
    query.x = static_cast<float>(centre.x());
    query.y = static_cast<float>(centre.y());
    query.z = static_cast<float>(centre.z());
    query.time = 0.0F;
    const auto to_float = [margin](double r) { return static_cast<float>(r + margin + r * 0x1p-22); };
    query.radius = to_float(radius);

    struct Call {
        Visit& visit;
        double radius;
        decltype(to_float)& round;
    } call{visit, radius, to_float};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        scene, &query, &context,
        [](RTCPointQueryFunctionArguments* arguments) {
            Call& self = *static_cast<Call*>(arguments->userPtr);
            const double before = self.radius;
            self.visit(arguments->primID, self.radius);
            if (self.radius >= before) return false;
            arguments->query->radius = self.round(self.radius);
            return true;
        },
        &call);
}

}  // namespace camdir::oracle
