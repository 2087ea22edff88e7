// The project's vector types. Right-handed, z up, lengths in map units, angles in radians.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <numbers>

namespace camdir {

using Vec3f = Eigen::Vector3f;  // stored and queried data
using Vec3d = Eigen::Vector3d;  // baking and the exact oracle
using Quatf = Eigen::Quaternionf;
using Box3f = Eigen::AlignedBox3f;
using Box3d = Eigen::AlignedBox3d;

// Metres of the nominal unit that the project's lengths are given in.
inline constexpr double metres_of_nominal_unit = 0.0254;

template <class Real>
inline constexpr Real radians_of_a_degree = std::numbers::pi_v<Real> / Real(180);

[[nodiscard]] constexpr float squared(float value) {
    return value * value;
}

// How deep the point is in the box: the distance to its nearest face, negative outside.
[[nodiscard]] inline double depth_in(const Box3d& box, const Vec3d& point) {
    return (point - box.min()).cwiseMin(box.max() - point).minCoeff();
}

}  // namespace camdir
