// The medial mesh and its free distances become what a MAP.vfs holds.
#pragma once

#include <vector>

#include "bake/medial_mesh.hpp"
#include "bake/stage.hpp"
#include "freespace/freespace.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// Drops the triangles whose slab is empty (no corner has a free distance > 0) and the vertices that no
// triangle uses. A scene without spawn points gets the middle of the ball that is widest within the bounds as
// one. Leaves metadata to the caller. Fails when nothing is left.
[[nodiscard]] Result<freespace::Contents> pack(const MedialMesh& mesh,
                                               const std::vector<float>& free_distance,
                                               const scene::Scene& scene, Stage& stage);

}  // namespace camdir::bake
