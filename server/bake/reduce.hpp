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
    double loss = 0.0;            // how much free distance the centre of a ball may lose, map units
    std::uint64_t triangles = 0;  // > 0: stop soon after no more than these are left
};

// Over the mesh's area; balls that are none count as 0.
[[nodiscard]] double mean_free_distance(const MedialMesh& mesh, const std::vector<float>& free_distance);

// Removes vertices by merging them into neighbours, those first that lose the least freespace volume. Part of
// the loss is spent beforehand: lower free distances let many more collapses keep clear of the obstacles; the
// vertices that are left get back what their slabs allow. Afterwards, as before:
// - every slab is certified against the obstacles;
// - each vertex, and each spawn point, has the free distance it had, less the loss, if that is positive; a
//   spawn point also half of what it had;
// - the mesh has the same connected parts, holes and branches, no edge without a triangle, and the roadmap
//   (edges between vertices of positive free distance) is connected where it was.
// The result does not depend on the number of threads. Drops the vertices that nobody uses.
[[nodiscard]] Result<void> reduce(MedialMesh& mesh, std::vector<float>& free_distance,
                                  const scene::Scene& scene, const Obstacles& obstacles,
                                  const Reduction& reduction, Stage& stage);

}  // namespace camdir::bake
