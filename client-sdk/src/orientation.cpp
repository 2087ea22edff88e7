#include "orientation.hpp"

#include <cmath>
#include <numbers>

namespace camdir::sdk {

void store_orientation(const float* pitch_yaw_roll, float* orientation) {
    constexpr double half_degree = std::numbers::pi / 360.0;
    const double pitch = pitch_yaw_roll[0] * half_degree;
    const double yaw = pitch_yaw_roll[1] * half_degree;
    const double roll = pitch_yaw_roll[2] * half_degree;
    const double sp = std::sin(pitch), cp = std::cos(pitch);
    const double sy = std::sin(yaw), cy = std::cos(yaw);
    const double sr = std::sin(roll), cr = std::cos(roll);
    orientation[0] = static_cast<float>(sr * cp * cy - cr * sp * sy);
    orientation[1] = static_cast<float>(cr * sp * cy + sr * cp * sy);
    orientation[2] = static_cast<float>(cr * cp * sy - sr * sp * cy);
    orientation[3] = static_cast<float>(cr * cp * cy + sr * sp * sy);
}

}  // namespace camdir::sdk
