// The slow component of the player's motion: what viewers want to follow.
#pragma once

#include "camera/plan.hpp"
#include "camera/profile.hpp"

namespace camdir::camera {

// Smooths the player's view direction and eye over the plan's future.
void smooth_heading(const MapProfile& profile, const History& history, Plan& plan);

}  // namespace camdir::camera
