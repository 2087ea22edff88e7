// The camera's orientation over the plan.
#pragma once

#include "camera/plan.hpp"
#include "camera/profile.hpp"

namespace camdir::camera {

// Sets the plan's look angles: from its positions to the player's smoothed eye, smoothed. The
// player may be a little off the middle of the picture.
void aim(const MapProfile& profile, const History& history, Plan& plan);

}  // namespace camdir::camera
