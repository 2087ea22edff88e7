// What cameras that are run over a trace are given, frame by frame, and what they give.
#pragma once

#include <cstdint>
#include <vector>

#include "camera/window.hpp"
#include "evaluation/camera_path.hpp"
#include "evaluation/trace.hpp"

namespace camdir::evaluation {

[[nodiscard]] inline double seconds(std::int64_t nanoseconds) {
    return static_cast<double>(nanoseconds) * 1e-9;
}

// All poses of a player; times from `start`, ns.
[[nodiscard]] std::vector<camera::TimedPose> timed_poses(const Trace& trace, std::uint32_t player,
                                                         std::int64_t start);

// The part of a player's poses that is known at a time which ascends from call to call.
class KnownPoses {
  public:
    // `all` must live as long. `look_ahead` in seconds.
    KnownPoses(camera::Window all, double look_ahead) : all_(all), look_ahead_(look_ahead) {}

    [[nodiscard]] camera::Window at(double time);

  private:
    camera::Window all_;
    double look_ahead_;
    std::size_t first_ = 0;
    std::size_t end_ = 0;
};

[[nodiscard]] CameraSample sampled(const camera::Camera& camera, bool cut);

// CPU time of this thread alone: unlike wall time, the same on a busy machine.
[[nodiscard]] double cpu_nanoseconds();

}  // namespace camdir::evaluation
