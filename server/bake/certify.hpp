// Free distances that are certified against the true obstacles: step 4 of the paper's section 4.2. Safety
// does not depend on the sampling.
#pragma once

#include <vector>

#include "bake/geometry/obstacles.hpp"
#include "bake/medial_mesh.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// d_f of each vertex, rounded down to a float: at most its clearance, and such that no slab of the mesh
// reaches into an obstacle (up to the rounding of doubles). May be negative. No triangle may cross an
// obstacle. A slab's free distances are lowered step by step until its violation is less than `tolerance`
// (map units, >= 0) or for 64 steps; then all three by the violation that is left, which frees the slab in
// either case.
[[nodiscard]] Result<std::vector<float>> free_distances(const MedialMesh& mesh,
                                                        const std::vector<double>& clearance,
                                                        const Obstacles& obstacles, double tolerance,
                                                        Stage& stage);

}  // namespace camdir::bake
