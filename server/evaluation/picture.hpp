// What a camera's picture shows: a view of 90 degrees across in the format 16:9, whatever the profile's is.
#pragma once

#include "evaluation/camera_path.hpp"

namespace camdir::evaluation {

// `point` lies in the central `share` (above 0, at most 1) of the picture's width and of its height, as
// tangents. Obstacles are ignored.
[[nodiscard]] bool in_picture(const CameraSample& camera, const Vec3d& point, double share);

// The player's box in map units, of which `unit` is 0.0254 m: 15 units to each side of the origin, from 24
// below it to 32 above, or 16 where the view is lower than 20.
[[nodiscard]] Box3d player_box(const TracePose& pose, double unit);

// In degrees; 0 when either has no direction.
[[nodiscard]] double degrees_between(const Vec3d& a, const Vec3d& b);

}  // namespace camdir::evaluation
