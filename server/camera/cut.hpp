// Where a cut lands.
#pragma once

#include "camera/objective.hpp"
#include "camera/player.hpp"
#include "camera/profile.hpp"
#include "camera/spot.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

// The best spot now: the least costly one that sees the anchor, with kept_clearance() where there is
// such a spot; else a place on the roadmap near the anchor that sees it; else the anchor itself, which is in
// freespace if any place is. `line`: of action, which the best spot heeds; may be null.
[[nodiscard]] Candidate landing(const freespace::Space& space, const MapProfile& profile,
                                const PlayerTrack& track, const LineOfAction* line = nullptr);

}  // namespace camdir::camera
