// Circumcentres of tetrahedra, robust also for almost flat ones.
#pragma once

#include <array>

#include "base/geometry.hpp"

namespace camdir::bake {

// The centre of the sphere through the four points, rounded from the exact one where the tetrahedron is too
// flat for floating point. The points must not lie in one plane.
[[nodiscard]] Vec3d circumcentre(const std::array<Vec3d, 4>& points);

}  // namespace camdir::bake
