// Mesh reduction: the paper's section 4.3 with half-edge collapses instead of swaps, which also remove
// vertices with non-manifold neighbourhoods.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bake/geometry/obstacles.hpp"
#include "bake/medial_mesh.hpp"
#include "bake/reduction/reduction.hpp"
#include "bake/stage.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// Limit of the vertices that one thread works on at a time: few enough to share out, enough to have an
// inside.
inline constexpr std::size_t region_size = 4096;

// Over the mesh's area; negative ones count as 0.
[[nodiscard]] double mean_free_distance(const MedialMesh& mesh, const std::vector<float>& free_distance);

// Removes vertices by merging them into neighbours, in the order of the freespace volume that is lost. Part
// of the loss is spent beforehand: lower free distances let many more collapses keep clear of the obstacles;
// the remaining vertices then regain what their slabs allow. Afterwards
// - every slab is certified against the obstacles, as before;
// - each vertex, and each spawn point, that had a free distance has it less the loss; a spawn point also half
//   of what it had above the offset radius;
// - the mesh has the same homotopy type (connected components, holes, cavities) and no edge without a
//   triangle, but not necessarily the same branches;
// - what the roadmap (edges between vertices with a free distance) connected is still connected.
// The result does not depend on the number of threads. Drops unused vertices. On failure mesh and free
// distances are unchanged.
[[nodiscard]] Result<void> reduce(MedialMesh& mesh, std::vector<float>& free_distance,
                                  const scene::Scene& scene, const Obstacles& obstacles,
                                  const Reduction& reduction, Stage& stage);

}  // namespace camdir::bake
