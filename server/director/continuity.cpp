#include "director/continuity.hpp"

#include <utility>

namespace camdir::director {

bool Continuity::broken(const PlayerPose& pose) {
    const bool declared = (pose.flags & pose_discontinuity) != 0;
    if (!pose.discontinuities) return declared;
    const std::uint32_t count = *pose.discontinuities;
    if (counts_.size() >= max_known && !counts_.contains(pose.player_id)) counts_.clear();
    const auto last = counts_.try_emplace(pose.player_id, count).first;
    return std::exchange(last->second, count) != count || declared;
}

void carry_discontinuities(const PoseFrame& from, PoseFrame& to) {
    if (from.epoch != to.epoch) return;
    for (const PlayerPose& pose : from.poses) {
        if ((pose.flags & pose_discontinuity) == 0) continue;
        for (PlayerPose& later : to.poses)
            if (later.player_id == pose.player_id) later.flags |= pose_discontinuity;
    }
}

}  // namespace camdir::director
