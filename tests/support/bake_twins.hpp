// Slow, obvious twins of what server/bake computes in closed form.
#pragma once

#include <array>
#include <vector>

#include "bake/geometry/triangle.hpp"

namespace camdir::test {

// The point of a triangle with the given weights.
[[nodiscard]] Vec3d point_of(const bake::Triangle3d& triangle, const std::array<double, 3>& weights);

// The smallest of |m - q| - r(m) that a search over ever finer grids finds. Never less than the true minimum.
[[nodiscard]] double searched_signed_gap(const bake::Triangle3d& corners,
                                         const std::array<double, 3>& free_distance,
                                         const bake::Triangle3d& obstacle);

// The same for the distance of a point.
[[nodiscard]] double searched_distance(const Vec3d& point, const bake::Triangle3d& triangle);

// From one point to the nearest of many.
[[nodiscard]] double distance_to_nearest(const Vec3d& point, const std::vector<Vec3d>& points);

}  // namespace camdir::test
