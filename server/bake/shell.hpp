// A shell of samples around the map, so that free space that is open to the outside has a medial surface up
// to the map's bounds. No obstacles: clearances do not know them.
#pragma once

#include <vector>

#include "base/geometry.hpp"

namespace camdir::bake {

// Of the shell's samples, and between the shell and the bounds: 4 d0, or more where that would be many.
[[nodiscard]] double shell_spacing(const Box3d& bounds, double d0);

// On the faces of the box that is `spacing` larger than `bounds` all around, in squares of at most `spacing`.
[[nodiscard]] std::vector<Vec3d> shell_samples(const Box3d& bounds, double spacing);

}  // namespace camdir::bake
