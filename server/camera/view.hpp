// The camera's view: the paper's section 3, "reasonable heuristic for the camera view".
#pragma once

#include "base/geometry.hpp"

namespace camdir::camera {

// Angles of a direction: yaw counter-clockwise from the x axis seen from above, pitch upwards; radians.
struct Look {
    float yaw = 0.0F;
    float pitch = 0.0F;
};

// The steepest that a camera stands above or below its player, rad.
template <class Real>
inline constexpr Real steepest_arm = Real(80) * radians_of_a_degree<Real>;

// A camera that another tracker has computed.
struct View {
    Vec3f position;
    Quatf orientation;
};

// The look along `direction` (any length). Straight up and straight down have no yaw of their own and take
// `yaw`; so does a direction of length 0, which looks level.
[[nodiscard]] Look look_along(const Vec3f& direction, float yaw);

[[nodiscard]] Vec3f direction_of(const Look& look);

// The rotation that looks along `look` with a level horizon: the y axis horizontal, the z axis never pointing
// down.
[[nodiscard]] Quatf orientation_of(const Look& look);

// `from` turned towards `to` by `share` of the way (0 .. 1), but by no more than `limit` radians of rotation.
[[nodiscard]] Look turned(const Look& from, const Look& to, float share, float limit);

// `angle` in (-pi, pi].
[[nodiscard]] float wrapped(float angle);

// The angle between two directions, 0 .. pi; 0 when one of them has no length.
[[nodiscard]] float angle_between(const Vec3f& a, const Vec3f& b);

}  // namespace camdir::camera
