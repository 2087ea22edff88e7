// The medial mesh and its free distances become what a MAP.vfs holds.
#pragma once

#include <vector>

#include "bake/medial_mesh.hpp"
#include "bake/stage.hpp"
#include "freespace/freespace.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// Nominal units. Free distances up to this are stored as 0: they come from doubles, whose rounding is less
// than 1e-9 at the coordinates of maps, so that smaller ones are rounding and not space.
inline constexpr double min_free_distance = 1e-6;

// Drops the triangles whose slab is empty (no corner has a free distance) and unused vertices. A scene
// without spawn points gets the centre of the widest ball within the bounds as one. Leaves metadata to the
// caller. Fails when nothing is left.
[[nodiscard]] Result<freespace::Contents> pack(const MedialMesh& mesh,
                                               const std::vector<float>& free_distance,
                                               const scene::Scene& scene, Stage& stage);

}  // namespace camdir::bake
