// A shell of samples around the map, so that free space that is open to the outside has a medial surface up
// to the map's bounds. The shell is no obstacle: clearances ignore it.
#pragma once

#include <vector>

#include "base/geometry.hpp"

namespace camdir::bake {

// Limit, approximate.
inline constexpr double max_shell_samples = 30'000.0;

struct Shell {
    double distance;  // from the bounds
    double spacing;   // of its samples, at least `distance`
};

// The shell has to keep further from the obstacles than their own samples, which are up to about
// `coarsest` / 2 from their points. Where open space is not deeper than the distance and 0.7 times the
// spacing together, the surface between it and the obstacles lies outside the bounds.
[[nodiscard]] Shell shell_around(const Box3d& bounds, double d0, double coarsest);

// On the faces of the box that is `around.distance` larger than `bounds` all around, in rectangles whose
// sides are at most `around.spacing`.
[[nodiscard]] std::vector<Vec3d> shell_samples(const Box3d& bounds, const Shell& around);

}  // namespace camdir::bake
