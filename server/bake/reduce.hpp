// Mesh reduction: the paper's section 4.3 with half-edge collapses instead of swaps, so that vertices with
// non-manifold neighbourhoods go too.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/medial_mesh.hpp"
#include "bake/obstacles.hpp"
#include "bake/stage.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

struct Reduction {
    // How much free distance may be lost at the centre of any ball of the unreduced mesh: absolute (map
    // units) plus a share of the ball's radius.
    double loss_absolute = 0.0;
    double loss_relative = 0.0;
    std::uint64_t triangles = 0;  // > 0: stop as soon as no more than these are left
};

// Removes vertices by merging them into neighbours, those first that lose the least freespace volume.
// Afterwards, as before:
// - every slab is certified against the obstacles;
// - each vertex that was removed, and each spawn point, is in a slab that gives it the free distance it had,
//   less the loss;
// - the mesh has the same connected parts, holes and branches, no edge without a triangle, and the roadmap
//   (edges between vertices of positive free distance) is connected where it was.
// The result does not depend on the number of threads. Drops the vertices that nobody uses.
[[nodiscard]] Result<void> reduce(MedialMesh& mesh, std::vector<float>& free_distance,
                                  const scene::Scene& scene, const Obstacles& obstacles,
                                  const Reduction& reduction, Stage& stage);

}  // namespace camdir::bake
