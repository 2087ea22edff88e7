// Arms that hold the camera behind the eye, as far as the map leaves room: the third-person camera of today's
// game engines.
#pragma once

#include "bench/cameras/camera.hpp"
#include "bench/queries/bullet_queries.hpp"
#include "bench/queries/embree_queries.hpp"

namespace camdir::bench {

// A sphere of radius 12 swept from the eye to the arm's end, without easing. `lag`: the arm follows the eye
// with this speed, 1/s, as that of Unreal's SpringArm with its camera lag; 0: it is fixed to the eye. `unit`:
// map units of 0.0254 m.
[[nodiscard]] Camera swept_arm(const BulletQueries& bullet, double lag, double unit);

// Rays from the eye to the arm's end and to the four corners round it. The arm shortens at once and grows
// again with an easing.
[[nodiscard]] Camera ray_arm(const EmbreeQueries& embree, double unit);

}  // namespace camdir::bench
