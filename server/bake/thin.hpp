// Welding of samples that lie almost in the same place.
#pragma once

#include <vector>

#include "bake/stage.hpp"

namespace camdir::bake {

// Keeps a subset of the samples, in ascending (x, y, z) order, such that every dropped one has a kept one
// within `distance` and no two kept ones are that close.
[[nodiscard]] Result<std::vector<Vec3d>> weld(std::vector<Vec3d> samples, double distance, Stage& stage);

}  // namespace camdir::bake
