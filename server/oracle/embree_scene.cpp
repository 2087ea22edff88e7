#include "oracle/embree_scene.hpp"

#include <cassert>

namespace camdir::oracle {

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

}  // namespace camdir::oracle
