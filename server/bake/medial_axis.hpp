// Points of the medial axis of the obstacles, before there is a Voronoi diagram: where the sampling takes
// its distances from (the paper's open question in section 4.1).
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
    double finest;  // triangles whose corners are no further from their centre than this are probed once
    double reach;   // balls of this radius and more do not matter
    std::uint64_t most = std::numeric_limits<std::uint64_t>::max();  // soon after more points it is left off
};

// Radius of the largest ball without obstacle inside that touches the surface point `q`, with its centre
// along the unit vector `normal`; at most `reach`. Relative error about 1e-4.
[[nodiscard]] double tangent_radius(const Vec3d& q, const Vec3d& normal, double reach,
                                    const Obstacles& obstacles);

// Centres of such balls with radius < reach, which are points of the medial axis: found from both sides of
// the obstacle triangles, as far as they lie in no solid. Probes are dense where the balls are small: every
// probed piece of a triangle reaches no further from its probe than half the ball's radius, or than `finest`.
// In the order of the triangles.
[[nodiscard]] Result<std::vector<Vec3d>> medial_axis(const Obstacles& obstacles, const Solids& solids,
                                                     const Probing& probing, Stage& stage);

}  // namespace camdir::bake
