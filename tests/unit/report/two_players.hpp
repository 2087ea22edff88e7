// A match of two standing players.
#pragma once

#include <vector>

#include "evaluation/judgement.hpp"
#include "evaluation/trace.hpp"

namespace camdir::report {

// 10 frames a second, in each first player 3 and then player 5.
inline evaluation::Trace two_players(std::size_t frames) {
    evaluation::Trace trace;
    trace.players = {3, 5};
    for (std::size_t frame = 0; frame < frames; ++frame) {
        trace.frames.push_back({static_cast<std::int64_t>(frame) * 100'000'000,
                                static_cast<std::uint32_t>(trace.poses.size()), 2});
        for (const std::uint32_t player : trace.players) {
            evaluation::TracePose pose;
            pose.player = player;
            pose.eye = Vec3d(100.0 * player, 0, 50);
            pose.view_height = 26.0F;
            trace.poses.push_back(pose);
        }
    }
    return trace;
}

inline std::vector<evaluation::Judgement> good_frames(const evaluation::Trace& trace) {
    evaluation::Judgement good;
    good.alive = good.counted = true;
    return std::vector(trace.poses.size(), good);
}

}  // namespace camdir::report
