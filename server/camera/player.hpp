// What a shot knows of its player from the poses so far.
#pragma once

#include "camera/camera.hpp"
#include "camera/profile.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

struct PlayerTrack {
    Vec3f eye = Vec3f::Zero();
    // Where the player is sought: the eye or, while no slab covers it, the last free point on the way to it.
    Vec3f anchor = Vec3f::Zero();
    Vec3f move = Vec3f::Zero();            // of the anchor in the last step
    Vec3f velocity = Vec3f::Zero();        // of the eye, low-passed
    Vec3f heading = Vec3f::UnitX();        // low-passed view direction, length 1
    Vec3f view = Vec3f::UnitX();           // view direction of the last pose
    Vec3f turning = Vec3f::Zero();         // its angular velocity, low-passed, rad/s
    std::uint32_t slab = freespace::none;  // of the anchor
    float clearance = 0.0F;                // free distance at the anchor
    bool covered = false;                  // the anchor is the eye
};

// Begins anew at `pose`: after a cut in the player's motion. An eye in no slab is sought at the nearest free
// point of the representation.
void restart(const freespace::Space& space, const MapProfile& profile, const Pose& pose, PlayerTrack& track);

// Follows the player to `pose`, `dt` seconds later.
void follow(const freespace::Space& space, const MapProfile& profile, const Pose& pose, float dt,
            PlayerTrack& track);

// Where the heading will probably point `ahead` seconds later: players stop turning soon.
[[nodiscard]] Vec3f predicted_heading(const PlayerTrack& track, float ahead);

// Where the anchor will probably be after profile.prediction seconds, no further than free space goes.
[[nodiscard]] Vec3f predicted_anchor(const freespace::Space& space, const MapProfile& profile,
                                     const PlayerTrack& track);

}  // namespace camdir::camera
