// The search for a lost player along the roadmap: T_vis of section 5.3.
#pragma once

#include "camera/player.hpp"
#include "camera/reach.hpp"
#include "freespace/roadmap.hpp"

namespace camdir::camera {

// Where the way to the player leads next: the furthest of the first vertices of the shortest roadmap path
// that the camera sees; the paper's second vertex when it sees no further. The camera's own position when
// there is no way.
[[nodiscard]] Vec3f next_on_the_way(const freespace::Space& space, const MapProfile& profile,
                                    const PlayerTrack& track, const Vec3f& start,
                                    freespace::RoadmapSearch& roadmap);

}  // namespace camdir::camera
