// A camera that goes to the best of many spots round the player, as third-person cameras with occlusion
// avoidance do.
#pragma once

#include "bench/cameras/camera.hpp"
#include "bench/queries/embree_queries.hpp"

namespace camdir::bench {

// 51 spots at the desired distance: 17 yaws each 10 degrees from that behind the player, and 3 elevations of
// 0, 25 and 50 degrees above it. The goal is the spot behind the player where free_arm() reaches it, else the
// one with the least sum of its angle off the camera's direction, in radians, and 10 times the blocked share
// of its arm. Yaw and pitch are damped towards it by a share of 1 - exp(-6 s), and the distance is that of an
// eased arm. The camera looks at the eye. `unit`: map units of 0.0254 m.
[[nodiscard]] Camera best_of_spots(const EmbreeQueries& embree, double unit);

}  // namespace camdir::bench
