// The stages "weld", of samples that almost coincide, and "thin", of a cloud's points: both keep a subset.
#pragma once

#include <vector>

#include "bake/stage.hpp"

namespace camdir::bake {

// Keeps a subset of the points, in ascending (x, y, z) order, such that every dropped one has a kept one
// within `distance` > 0 and no two kept ones are that close. Fails when interrupted.
[[nodiscard]] Result<std::vector<Vec3d>> thin(std::vector<Vec3d> points, double distance, Stage& stage);

}  // namespace camdir::bake
