// The camera's path: smooth, near its goals, and round what is in the way.
#pragma once

#include "camera/candidates.hpp"
#include "camera/plan.hpp"
#include "camera/profile.hpp"

namespace camdir::camera {

// Sets the plan's positions from its goals. Where the path cuts a corner of its goals, these move out, so
// that it keeps their distance. Then looks along its lines of sight, and where one is blocked slides the goal
// along the obstacle and makes it count more; again until nothing is blocked, a few rounds at most.
void refine_path(const MapProfile& profile, const History& history, Beams& beams, Plan& plan);

}  // namespace camdir::camera
