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

template <class Real>
inline constexpr Real radians_of_a_degree = std::numbers::pi_v<Real> / Real(180);

}  // namespace camdir
