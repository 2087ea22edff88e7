// Keeping the player in sight when the plain move would lose him: the places near the camera that still see
// him, the least costly of which is taken.
#pragma once

#include <optional>

#include "camera/objective.hpp"
#include "camera/reach.hpp"

namespace camdir::camera {

[[nodiscard]] bool is_seen(const Candidate& candidate);

// The camera can be there without breaking a promise of the profile: seen through the threshold's clearance,
// and kept_clearance() kept.
[[nodiscard]] bool acceptable(const MapProfile& profile, const PlayerTrack& track,
                              const Candidate& candidate);

// Among places reachable in one step of at most profile.step_limit (staying, moving with the player, `wanted`
// swung round him and pulled in along the new line of sight, and retreats along the old line of sight, which
// was free) the one of least cost that sees the player, of those with kept_clearance() if there are any.
[[nodiscard]] std::optional<Candidate> regain_sight(const freespace::Space& space, const MapProfile& profile,
                                                    const PlayerTrack& track, const Motion& motion,
                                                    const Vec3f& wanted);

// `target`, or the point of the segment to it that is `limit` away from `start`.
[[nodiscard]] Vec3f within_step(const Vec3f& start, const Vec3f& target, float limit);

}  // namespace camdir::camera
