#include "evaluation/replay.hpp"

#include <ctime>

namespace camdir::evaluation {
namespace {

constexpr double history = 0.5;     // s of poses before a camera that it is given
constexpr double same_time = 1e-9;  // s

camera::Pose tracked(const TracePose& pose) {
    camera::Pose seen;
    seen.eye = pose.eye.cast<float>();
    seen.orientation = pose.orientation.cast<float>().normalized();
    seen.velocity = pose.velocity.cast<float>();
    seen.alive = pose.alive;
    seen.discontinuity = pose.discontinuity;
    return seen;
}

}  // namespace

std::vector<camera::TimedPose> timed_poses(const Trace& trace, std::uint32_t player, std::int64_t start) {
    std::vector<camera::TimedPose> poses;
    poses.reserve(trace.frames.size());
    const auto track = track_of(trace, player);
    for (std::size_t frame = 0; frame < track.size(); ++frame) {
        const bool present = track[frame] != absent;
        poses.push_back({seconds(trace.frames[frame].time - start),
                         present ? tracked(trace.poses[track[frame]]) : camera::Pose{}, present});
    }
    return poses;
}

camera::Window KnownPoses::at(double time) {
    while (end_ < all_.size() && all_[end_].time <= time + look_ahead_ + same_time)
        ++end_;
    while (first_ + 1 < end_ && all_[first_ + 1].time <= time - history)
        ++first_;
    return all_.subspan(first_, end_ - first_);
}

CameraSample sampled(const camera::Camera& camera, bool cut) {
    return {camera.position.cast<double>(), camera.orientation.cast<double>().normalized(), cut,
            (camera.flags & camera::target_visible) != 0};
}

double cpu_nanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

}  // namespace camdir::evaluation
