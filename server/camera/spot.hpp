// The favourable spot to see the player from: what the moves for c_dist and c_angle aim at, and where a cut
// lands. The paper takes the point behind the player; where obstacles are in between, the best free point of
// a fan of directions round it.
#pragma once

#include "camera/player.hpp"
#include "camera/profile.hpp"
#include "freespace/freespace.hpp"

namespace camdir::camera {

struct Spot {
    Vec3f offset = Vec3f::Zero();  // from the anchor
    float cost = 0.0F;
};

// The least costly spot that a free beam joins to the anchor. Directions up to profile.swing from behind are
// tried, the cheapest first, until none can be better. `camera` is where the camera is now: other directions
// cost more, and the beam must also be free from where the player will be.
[[nodiscard]] Spot spot_to_move_to(const freespace::Freespace& freespace, const MapProfile& profile,
                                   const PlayerTrack& track, const Vec3f& camera);

// The same in all directions, wherever the camera is.
[[nodiscard]] Spot spot_to_cut_to(const freespace::Freespace& freespace, const MapProfile& profile,
                                  const PlayerTrack& track);

}  // namespace camdir::camera
