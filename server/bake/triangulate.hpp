// Triangulation of the Voronoi faces: step 3 of the paper's section 4.2.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/medial_mesh.hpp"
#include "bake/stage.hpp"
#include "bake/voronoi.hpp"

namespace camdir::bake {

// Appends the Delaunay triangulation of a convex plane polygon, as triples of positions in it. Among the
// triangulations it follows the distance to the obstacles best: its error is smallest for |x|^2.
void triangulate_convex(std::span<const Vec3d> polygon, std::vector<std::array<std::uint32_t, 3>>& triangles);

// Rounds the vertices to floats, with which all later stages compute. Drops triangles that rounding made
// degenerate, and all but one of those with the same corners.
[[nodiscard]] Result<MedialMesh> triangulate(const VoronoiFaces& faces, Stage& stage);

}  // namespace camdir::bake
