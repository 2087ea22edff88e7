// Points of the medial axis of the obstacles, before there is a Voronoi diagram: they determine the sampling
// distances (the paper's open question in section 4.1).
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bake/geometry/obstacles.hpp"
#include "bake/geometry/solids.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// How densely the obstacles are probed, in map units.
struct Probing {
    double finest;  // triangles whose corners are at most this far from their centre are probed once
    double reach;   // limit of the radii that matter
    // Probing ends soon after more points than this.
    std::uint64_t max_points = std::numeric_limits<std::uint64_t>::max();
};

// The shrinking ball method (Ma, Bae and Choi 2012): radius of the largest ball without obstacle inside that
// touches the surface point `q`, with its centre along the unit vector `normal`; at most `reach`. Relative
// error about 1e-4.
[[nodiscard]] double shrinking_ball_radius(const Vec3d& q, const Vec3d& normal, double reach,
                                           const Obstacles& obstacles);

// Centres of such balls with radius < reach, which are points of the medial axis: found from those sides of
// the obstacle triangles that lie in no solid. Probes are dense where the balls are small: no point of a
// probed piece of a triangle is further from its probe than half the ball's radius, or than `finest`. In the
// order of the triangles.
[[nodiscard]] Result<std::vector<Vec3d>> medial_axis(const Obstacles& obstacles, const Solids& solids,
                                                     const Probing& probing, Stage& stage);

}  // namespace camdir::bake
