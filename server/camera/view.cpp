#include "camera/view.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace camdir::camera {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float vertical = 1e-4F;  // horizontal share of a direction below which its yaw is noise

}  // namespace

Look look_along(const Vec3f& direction, float yaw) {
    const float horizontal = std::hypot(direction.x(), direction.y());
    Look look;
    look.pitch = std::atan2(direction.z(), horizontal);
    look.yaw =
        horizontal > vertical * std::abs(direction.z()) ? std::atan2(direction.y(), direction.x()) : yaw;
    return look;
}

Vec3f direction_of(const Look& look) {
    const float horizontal = std::cos(look.pitch);
    return {horizontal * std::cos(look.yaw), horizontal * std::sin(look.yaw), std::sin(look.pitch)};
}

Quatf orientation_of(const Look& look) {
    return Quatf(Eigen::AngleAxisf(look.yaw, Vec3f::UnitZ()) *
                 Eigen::AngleAxisf(-look.pitch, Vec3f::UnitY()));
}

Look turned(const Look& from, const Look& to, float share, float limit) {
    const float yaw = wrapped(to.yaw - from.yaw) * share;
    const float pitch = (to.pitch - from.pitch) * share;
    // Yaw rotates the view by less the steeper it is, but the image turns about its centre all the same.
    const float rotation = std::hypot(yaw, pitch);
    const float allowed = rotation > limit ? limit / rotation : 1.0F;
    return {wrapped(from.yaw + yaw * allowed), from.pitch + pitch * allowed};
}

float wrapped(float angle) {
    if (angle > -pi && angle <= pi) return angle;
    const float turn = std::remainder(angle, 2.0F * pi);
    return turn <= -pi ? pi : turn;
}

float angle_between(const Vec3f& a, const Vec3f& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace camdir::camera
