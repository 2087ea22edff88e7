// Quake's view angles.
#pragma once

#include <cmath>

#include "base/geometry.hpp"

namespace camdir {

// The angles need not be normalised; positive pitch looks down.
[[nodiscard]] inline Eigen::Quaterniond quake_orientation(double pitch_degrees, double yaw_degrees,
                                                          double roll_degrees) {
    const auto turn = [](double degrees, const Vec3d& axis) {
        return Eigen::AngleAxisd(std::remainder(degrees, 360.0) * radians_of_a_degree<double>, axis);
    };
    return turn(yaw_degrees, Vec3d::UnitZ()) * turn(pitch_degrees, Vec3d::UnitY()) *
           turn(roll_degrees, Vec3d::UnitX());
}

}  // namespace camdir
