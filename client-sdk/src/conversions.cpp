// The C functions that convert between the axes and units of game engines and those of the map.
#include <camera_director/camera_director.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "checks.hpp"

namespace camdir::sdk {

namespace {

// Component i here is sign[i] times the engine's component source[i].
struct Axes {
    std::array<std::size_t, 3> source;
    std::array<float, 3> sign;
    float handedness;  // 1 = right-handed as the map, -1 = left-handed
    double metres_per_unit;
};

const Axes& axes_of(std::uint32_t engine) {
    static constexpr Axes quake{{0, 1, 2}, {1.0F, 1.0F, 1.0F}, 1.0F, 0.0254};
    static constexpr Axes unity{{2, 0, 1}, {1.0F, -1.0F, 1.0F}, -1.0F, 1.0};
    static constexpr Axes unreal{{0, 1, 2}, {1.0F, -1.0F, 1.0F}, -1.0F, 0.01};
    switch (engine) {
        case CDIR_ENGINE_QUAKE:
            return quake;
        case CDIR_ENGINE_UNITY:
            return unity;
        case CDIR_ENGINE_UNREAL:
            return unreal;
        default:
            throw Failure{CDIR_INVALID_ARGUMENT,
                          "engine is " + std::to_string(engine) + ", none of CDIR_ENGINE_"};
    }
}

// The results are stored at the end: `from` and `to` may be the same array.
void store_here(const Axes& axes, double factor, const float* from, float* to) {
    std::array<float, 3> here;
    for (std::size_t i = 0; i < 3; ++i)
        here[i] = static_cast<float>(factor * double{axes.sign[i] * from[axes.source[i]]});
    require(all_finite(here.data(), 3), "a converted position is out of range");
    std::copy(here.begin(), here.end(), to);
}

void store_there(const Axes& axes, double factor, const float* from, float* to) {
    std::array<float, 3> there;
    for (std::size_t i = 0; i < 3; ++i)
        there[axes.source[i]] = static_cast<float>(factor * double{axes.sign[i] * from[i]});
    require(all_finite(there.data(), 3), "a converted position is out of range");
    std::copy(there.begin(), there.end(), to);
}

void check_position(float metres_per_unit, const float* position, const float* converted) {
    require(position != nullptr, "position is null");
    require(converted != nullptr, "converted is null");
    require(std::isfinite(metres_per_unit) && metres_per_unit > 0.0F,
            "metres_per_unit must be greater than 0");
    require(all_finite(position, 3), "a position is not finite");
}

// Exactly 1 where the units are the same in single precision, so that nothing is rounded.
double ratio(double of, double to) {
    return static_cast<float>(of) == static_cast<float>(to) ? 1.0 : of / to;
}

void check_orientation(const float* orientation, const float* converted) {
    require(orientation != nullptr, "orientation is null");
    require(converted != nullptr, "converted is null");
    require(all_unit(orientation, 1), "an orientation is not of length 1");
}

// About z by yaw, then about y by pitch, then about x by roll.
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

// Of the camera's axes, as columns of a rotation matrix, only the numbers that the angles need.
void store_angles(const float* orientation, float* pitch_yaw_roll) {
    constexpr double degrees = 180.0 / std::numbers::pi;
    const double length = std::hypot(std::hypot(double{orientation[0]}, double{orientation[1]}),
                                     std::hypot(double{orientation[2]}, double{orientation[3]}));
    const double x = orientation[0] / length, y = orientation[1] / length;
    const double z = orientation[2] / length, w = orientation[3] / length;
    const double forward_x = 1 - 2 * (y * y + z * z), forward_y = 2 * (x * y + w * z);
    const double forward_z = 2 * (x * z - w * y);
    const double left_x = 2 * (x * y - w * z), left_y = 1 - 2 * (x * x + z * z);
    const double left_z = 2 * (y * z + w * x), up_z = 1 - 2 * (x * x + y * y);
    const double level = std::hypot(forward_x, forward_y);
    const bool vertical = level < 1e-6;  // yaw and roll turn about the same axis: all is yaw
    pitch_yaw_roll[0] = static_cast<float>(degrees * std::atan2(-forward_z, level));
    pitch_yaw_roll[1] = static_cast<float>(
        degrees * (vertical ? std::atan2(-left_x, left_y) : std::atan2(forward_y, forward_x)));
    pitch_yaw_roll[2] = static_cast<float>(vertical ? 0.0 : degrees * std::atan2(left_z, up_z));
}

}  // namespace

}  // namespace camdir::sdk

using namespace camdir::sdk;

cdir_status cdir_position_from_engine(uint32_t engine, float metres_per_unit, const float* position,
                                      float* converted) noexcept {
    return guarded([&] {
        const Axes& axes = axes_of(engine);
        check_position(metres_per_unit, position, converted);
        store_here(axes, ratio(axes.metres_per_unit, metres_per_unit), position, converted);
        return CDIR_OK;
    });
}

cdir_status cdir_position_to_engine(uint32_t engine, float metres_per_unit, const float* position,
                                    float* converted) noexcept {
    return guarded([&] {
        const Axes& axes = axes_of(engine);
        check_position(metres_per_unit, position, converted);
        store_there(axes, ratio(metres_per_unit, axes.metres_per_unit), position, converted);
        return CDIR_OK;
    });
}

// A reflection turns the sense of a rotation.
cdir_status cdir_orientation_from_engine(uint32_t engine, const float* orientation,
                                         float* converted) noexcept {
    return guarded([&] {
        const Axes& axes = axes_of(engine);
        check_orientation(orientation, converted);
        store_here(axes, axes.handedness, orientation, converted);
        converted[3] = orientation[3];
        return CDIR_OK;
    });
}

cdir_status cdir_orientation_to_engine(uint32_t engine, const float* orientation, float* converted) noexcept {
    return guarded([&] {
        const Axes& axes = axes_of(engine);
        check_orientation(orientation, converted);
        store_there(axes, axes.handedness, orientation, converted);
        converted[3] = orientation[3];
        return CDIR_OK;
    });
}

cdir_status cdir_orientation_from_angles(const float* angles, float* orientation) noexcept {
    return guarded([&] {
        require(angles != nullptr, "angles is null");
        require(orientation != nullptr, "orientation is null");
        require(all_finite(angles, 3), "an angle is not finite");
        store_orientation(angles, orientation);
        return CDIR_OK;
    });
}

cdir_status cdir_orientation_to_angles(const float* orientation, float* angles) noexcept {
    return guarded([&] {
        require(orientation != nullptr, "orientation is null");
        require(angles != nullptr, "angles is null");
        require(all_unit(orientation, 1), "an orientation is not of length 1");
        store_angles(orientation, angles);
        return CDIR_OK;
    });
}
