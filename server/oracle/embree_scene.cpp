#include "oracle/embree_scene.hpp"

#include <algorithm>
#include <cassert>

namespace camdir::oracle {
namespace {

using BoxOf = std::function<Box3d(std::size_t)>;

void write_bounds(const RTCBoundsFunctionArguments* arguments) {
    const Box3d box = (*static_cast<const BoxOf*>(arguments->geometryUserPtr))(arguments->primID);
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

Device make_device() {
    Device device(rtcNewDevice(nullptr));
    assert(device != nullptr);
    return device;
}

EmbreeScene make_scene(RTCDevice device, RTCGeometry geometry) {
    EmbreeScene scene(rtcNewScene(device));
    rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

EmbreeScene make_scene(RTCDevice device, std::size_t count, const BoxOf& box_of) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(count));
    rtcSetGeometryUserData(geometry, const_cast<BoxOf*>(&box_of));
    rtcSetGeometryBoundsFunction(geometry, write_bounds, nullptr);
    return make_scene(device, geometry);
}

}  // namespace camdir::oracle
