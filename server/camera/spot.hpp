// The favourable spot to see the player from: what the moves for c_dist and c_angle aim at, and where a cut
// lands. The paper takes the point behind the player; where obstacles are in between, the best free point of
// a fan of directions round it.
#pragma once

#include "camera/player.hpp"
#include "camera/profile.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

struct Spot {
    Vec3f offset = Vec3f::Zero();  // from the anchor
    float cost = 0.0F;
};

// Of a cut between the cameras of two enemies: the camera that begins prefers the side of the line through
// both, seen from above, where the one before was.
struct LineOfAction {
    Vec3f other = Vec3f::Zero();   // the eye of whom the camera before was of
    Vec3f camera = Vec3f::Zero();  // that camera
};

// What a shot remembers of its last choice.
struct SpotMemory {
    Vec3f direction = Vec3f::UnitX();  // from the anchor
    float age = 1.0F;                  // seconds since the whole fan was looked through
};

// The spot behind the player if free beams join it to the anchor and to where the anchor will be. Otherwise
// the least costly spot within profile.swing of behind, directions other than the one to `camera` costing
// more; the whole fan is looked through at most 16 times a second, in between only the last choice is
// compared. `dt` is the time since the last call.
[[nodiscard]] Spot spot_to_move_to(const freespace::Space& space, const MapProfile& profile,
                                   const PlayerTrack& track, const Vec3f& camera, float dt,
                                   SpotMemory& memory);

// The least costly spot of all directions that a free beam joins to the anchor, wherever the camera is;
// across the line of action, and 5 degrees beside it, each costs as much more as a quarter turn. `line` may
// be null.
[[nodiscard]] Spot spot_to_cut_to(const freespace::Space& space, const MapProfile& profile,
                                  const PlayerTrack& track, const LineOfAction* line);

}  // namespace camdir::camera
