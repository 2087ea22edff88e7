// The chase camera of HLTV, GoldSrc's spectator client.
#pragma once

#include "bench/cameras/camera.hpp"
#include "bench/queries/bullet_queries.hpp"

namespace camdir::bench {

// Yaw and pitch each follow the player's at most at 180 degrees a second. The camera stands 120 units of
// 0.0254 m behind the eye in that direction, or where a cube of 12 units stops; from there the distance comes
// back at 32 units a second. `unit`: map units of 0.0254 m.
[[nodiscard]] Camera hltv_chase(const BulletQueries& bullet, double unit);

}  // namespace camdir::bench
