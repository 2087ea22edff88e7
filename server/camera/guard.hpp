// The last word on every step of a planned camera: whatever the plan wants, the camera sees the player from
// freespace and got there through freespace.
#pragma once

#include <optional>

#include "camera/reach.hpp"

namespace camdir::camera {

// `wanted` if the whole step to it is free, at most profile.step_limit long, and ends with the minimum
// clearance and in sight of the player; else a point of the new line of sight nearer to the player that is;
// else what regain_sight() finds. None when the player cannot be seen from anywhere in reach. `recent`: balls
// near the line of sight.
[[nodiscard]] std::optional<Candidate> guarded(const freespace::Space& space, const MapProfile& profile,
                                               const PlayerTrack& track, const Motion& motion,
                                               const Vec3f& wanted, freespace::RecentBalls& recent);

}  // namespace camdir::camera
