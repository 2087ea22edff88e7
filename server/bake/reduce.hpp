// Mesh reduction: the paper's section 4.3 with half-edge collapses instead of swaps, so that vertices with
// non-manifold neighbourhoods go too.
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

// Vertices that one thread works on at a time, at most: few enough to share out, enough to have an inside.
inline constexpr std::size_t region_size = 4096;

// Over the mesh's area; negative ones count as 0.
[[nodiscard]] double mean_free_distance(const MedialMesh& mesh, const std::vector<float>& free_distance);

// Removes vertices by merging them into neighbours, those first that lose the least freespace volume. Part of
// the loss is spent beforehand: lower free distances let many more collapses keep clear of the obstacles; the
// vertices that are left get back what their slabs allow. Afterwards, as before:
// - every slab is certified against the obstacles;
// - each vertex, and each spawn point, that had a free distance has it less the loss; a spawn point also half
//   of what it had above the margin;
// - the mesh has the same connected parts, holes and branches, no edge without a triangle, and the roadmap
//   (edges between vertices that have a free distance) is connected where it was.
// The result does not depend on the number of threads. Drops the vertices that nobody uses.
[[nodiscard]] Result<void> reduce(MedialMesh& mesh, std::vector<float>& free_distance,
                                  const scene::Scene& scene, const Obstacles& obstacles,
                                  const Reduction& reduction, Stage& stage);

}  // namespace camdir::bake
