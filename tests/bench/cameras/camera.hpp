// Cameras of one player each, which follow them pose by pose without knowing what comes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "evaluation/camera_path.hpp"
#include "evaluation/recording.hpp"

namespace camdir::bench {

// The camera at a pose, `seconds` after the frame before: 0 in a trace's first. It begins anew, with a cut,
// at a pose that is marked as a discontinuity, as a player's first one always is.
using Follow = std::function<evaluation::CameraSample(const evaluation::TracePose& pose, double seconds)>;

struct Camera {
    std::string name;
    std::function<Follow()> make;  // for another player
};

// One player after the other on one thread. The times are those of each update, wall clock, less the clock's
// own; there are no objective terms.
[[nodiscard]] evaluation::Recording follow_all(const evaluation::Trace& trace, const Camera& camera);

// The desired distance between the camera and the eye, units of 0.0254 m, as in evaluation::Metrics.
inline constexpr double desired_distance = 120.0;

}  // namespace camdir::bench
