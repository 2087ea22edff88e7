// The slow, obvious answers to the oracle's questions: every triangle and every brush is looked at.
#pragma once

#include "scene/scene.hpp"

namespace camdir::test {

[[nodiscard]] double distance_to_triangle(const Vec3d& point, const Vec3d& a, const Vec3d& b, const Vec3d& c);

// Smallest distance between a segment and a triangle; 0 when they meet.
[[nodiscard]] double distance_to_triangle(const Vec3d& from, const Vec3d& to, const Vec3d& a, const Vec3d& b,
                                          const Vec3d& c);

[[nodiscard]] double depth_in_solid(const scene::Scene& scene, const Vec3d& point);  // < 0: in none
[[nodiscard]] double clearance(const scene::Scene& scene, const Vec3d& point);
// Smallest distance of the segment from any triangle.
[[nodiscard]] double clearance(const scene::Scene& scene, const Vec3d& from, const Vec3d& to);

}  // namespace camdir::test
