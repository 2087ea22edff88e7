// The objective c of the paper's section 3.
#pragma once

#include "camera/camera.hpp"
#include "camera/player.hpp"
#include "camera/profile.hpp"

namespace camdir::camera {

// A place where the camera could be at the end of this step, and what the representation says about it.
struct Candidate {
    Vec3f position = Vec3f::Zero();
    std::uint32_t slab = freespace::none;
    float clearance = 0.0F;  // free distance at the position
    // Lower bound of the clearance along the line of sight to the anchor; 0: the player is not seen.
    float sight_clearance = 0.0F;
    // The clearance, but no more than the profile's, and less what movers take of it in the next moment.
    float room = 0.0F;
};

// How the camera came to where it is.
struct Motion {
    Vec3f position;  // o_C
    Vec3f velocity;  // (o_C - o_C^-) / the last step's time
    float dt;        // the time of this step, s
};

// c = c_vis (c_dist + c_angle + c_inertia_dist + c_inertia_angle + c_safe) at the candidate. Every deviation
// counts as the square of its share of the profile's tolerance: small ones are free, and a compromise is
// cheaper than giving one of them up. c_vis of a player who is not
// seen is so large that no other term matters.
[[nodiscard]] ObjectiveTerms objective(const MapProfile& profile, const PlayerTrack& track,
                                       const Motion& motion, const Candidate& candidate);

}  // namespace camdir::camera
