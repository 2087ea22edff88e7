#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

#include "evaluation/camera_path.hpp"

// Whatever the bytes: an error with a message, or a unit camera for each pose of a fixed trace.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace camdir::evaluation;
    Trace trace;
    trace.players = {0, 1};
    trace.poses.resize(3);
    trace.poses[1].player = 1;
    trace.frames = {{0, 0, 2}, {16'000'000, 2, 1}};
    const auto cameras = parse_cameras(std::as_bytes(std::span(data, size)), "input", trace);
    if (!cameras) {
        assert(!cameras.error().message.empty());
        return 0;
    }
    assert(cameras->size() == trace.poses.size());
    for (const CameraSample& camera : *cameras) {
        assert(camera.position.allFinite());
        assert(std::abs(camera.orientation.norm() - 1.0) < 1e-9);
    }
    return 0;
}
