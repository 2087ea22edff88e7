// The individual moves T_j of the paper's section 5.3, one for the terms of the objective, and their weighted
// average.
#pragma once

#include "camera/objective.hpp"
#include "camera/player.hpp"
#include "camera/profile.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

struct Moves {
    Vec3f spot = Vec3f::Zero();        // T_dist/angle: to the spot behind the player
    Vec3f inertia = Vec3f::Zero();     // T_inertia: the move before, stretched to this step's time
    Vec3f safety = Vec3f::Zero();      // T_safe: to the safest vertex of the current slab
    Vec3f visibility = Vec3f::Zero();  // T_vis: the player's own move, which keeps what is seen
};

// T_safe: to the vertex v of the slab that minimises w(|v - position|) / d_f(v). Zero without a slab.
[[nodiscard]] Vec3f move_to_safety(const freespace::Space& space, const Vec3f& position, std::uint32_t slab);

// The weighted average while the player is seen. With unit weights and away from T_safe it is the exact step
// of a critically damped spring of time constant profile.motion_smoothing between the camera and its spot,
// carried along with the player, whatever dt: with r = exp(-dt / constant) the spot weighs (1-r)^2, inertia
// r^2, the player's move 2r(1-r). T_safe's weight grows with `speed`.
[[nodiscard]] Vec3f average_when_seen(const MapProfile& profile, const Moves& moves, float speed, float dt);

// The weighted average in a search: T_vis leads along the roadmap, `urgency` (>= 1) times as strong as the
// spot, and the camera is no longer carried along.
[[nodiscard]] Vec3f average_when_lost(const MapProfile& profile, const Moves& moves, float urgency, float dt);

}  // namespace camdir::camera
