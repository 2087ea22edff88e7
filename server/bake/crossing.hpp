// Medial triangles that cross an obstacle: no free distance makes them safe. The few that exist come from
// edges shorter than twice the sampling distance, merged vertices and rounding.
#pragma once

#include <vector>

#include "bake/geometry/obstacles.hpp"
#include "bake/medial_mesh.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// Removes every triangle that has a point in common with an obstacle, decided by exact predicates.
// `clearance` is that of the vertices.
[[nodiscard]] Result<void> remove_crossing(MedialMesh& mesh, const std::vector<double>& clearance,
                                           const Obstacles& obstacles, Stage& stage);

}  // namespace camdir::bake
