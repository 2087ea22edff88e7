// True clearance at the vertices of the medial mesh.
#pragma once

#include <vector>

#include "bake/geometry/obstacles.hpp"
#include "bake/medial_mesh.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// Distance from each vertex to the nearest obstacle, up to the rounding of doubles.
[[nodiscard]] Result<std::vector<double>> clearances(const MedialMesh& mesh, const Obstacles& obstacles,
                                                     Stage& stage);

}  // namespace camdir::bake
