// Traces of a few frames, written by the tests' hand.
#pragma once

#include <initializer_list>

#include "evaluation/trace.hpp"

namespace camdir::evaluation {

// A living, standing player at the origin of the map who looks along x.
inline TracePose standing(std::uint32_t player, const Vec3d& eye) {
    TracePose pose;
    pose.player = player;
    pose.eye = eye;
    pose.view_height = 26.0F;
    return pose;
}

inline void add_frame(Trace& trace, std::int64_t milliseconds, std::initializer_list<TracePose> poses) {
    trace.frames.push_back({milliseconds * 1'000'000, static_cast<std::uint32_t>(trace.poses.size()),
                            static_cast<std::uint32_t>(poses.size())});
    trace.poses.insert(trace.poses.end(), poses);
}

}  // namespace camdir::evaluation
