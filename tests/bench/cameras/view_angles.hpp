// View directions as two angles, which some cameras turn one by one.
#pragma once

#include <algorithm>
#include <cmath>

#include "evaluation/trace.hpp"

namespace camdir::bench {

// Degrees; positive pitch looks down.
struct ViewAngles {
    double yaw = 0.0;
    double pitch = 0.0;
};

[[nodiscard]] inline ViewAngles view_angles(const evaluation::TracePose& pose) {
    const Vec3d forward = pose.orientation * Vec3d::UnitX();
    return {std::atan2(forward.y(), forward.x()) / radians_of_a_degree<double>,
            -std::asin(std::clamp(forward.z(), -1.0, 1.0)) / radians_of_a_degree<double>};
}

[[nodiscard]] inline Eigen::Quaterniond orientation_of(const ViewAngles& angles) {
    return quake_orientation(angles.pitch, angles.yaw, 0.0);
}

// From `from` to `to` the short way, -180 .. 180 degrees.
[[nodiscard]] inline double turn_between(double from, double to) {
    return std::remainder(to - from, 360.0);
}

}  // namespace camdir::bench
