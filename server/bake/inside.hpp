// Which parts of the medial mesh are freespace that a player can reach.
#pragma once

#include <vector>

#include "bake/geometry/solids.hpp"
#include "bake/medial_mesh.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// Keeps the parts of the mesh that are connected with a spawn point, over triangles that share a vertex; no
// triangle may cross an obstacle. A spawn point's eye is connected to the vertices whose free ball holds it.
// Without spawn points the part with the largest area of balls within the map's bounds stays. Also
// drops triangles with a corner in a solid. `clearance` is that of the vertices. Fails when no spawn point is
// connected to the mesh.
[[nodiscard]] Result<void> keep_inside(MedialMesh& mesh, const std::vector<double>& clearance,
                                       const scene::Scene& scene, const Solids& solids, Stage& stage);

// The same among the points of a cloud, where a place is free when it is further than `offset_radius` from
// all of them: parts are connected over edges whose ends have `passage` more than that. `clearance` and
// `free_distance` are those towards the points. Without spawn points the part of the largest free area within
// the bounds stays.
[[nodiscard]] Result<void> keep_inside_cloud(MedialMesh& mesh, const std::vector<double>& clearance,
                                             const std::vector<float>& free_distance, double offset_radius,
                                             double passage, const scene::Scene& scene, Stage& stage);

}  // namespace camdir::bake
