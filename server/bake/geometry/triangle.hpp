// Triangles in space, in double precision.
#pragma once

#include <array>

#include "base/geometry.hpp"

namespace camdir::bake {

using Triangle3d = std::array<Vec3d, 3>;

[[nodiscard]] inline Box3d box_of(const Triangle3d& triangle) {
    Box3d box(triangle[0]);
    box.extend(triangle[1]);
    box.extend(triangle[2]);
    return box;
}

[[nodiscard]] inline double area(const Triangle3d& triangle) {
    return 0.5 * (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm();
}

// The corner from which the longest edge leads to the next corner; of equal ones the first.
[[nodiscard]] int longest_edge(const Triangle3d& triangle);

// The square of its length.
[[nodiscard]] double longest_edge_length2(const Triangle3d& triangle);

// Cut through the middle of the longest edge, with the triangle's orientation.
[[nodiscard]] std::array<Triangle3d, 2> halves(const Triangle3d& triangle);

// The point of the closed segment nearest to `p`. The segment may be a point.
[[nodiscard]] Vec3d closest_point(const Vec3d& a, const Vec3d& b, const Vec3d& p);

// The point of the closed triangle nearest to `p`. The triangle may be a segment or a point.
[[nodiscard]] Vec3d closest_point(const Triangle3d& triangle, const Vec3d& p);

}  // namespace camdir::bake
