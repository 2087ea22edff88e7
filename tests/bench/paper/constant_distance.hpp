// The paper's free distance (section 4.2, step 4): half of the distance of the samples that induce a face,
// less d0; at a vertex the minimum over its triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/medial_mesh.hpp"
#include "bench/paper/voronoi.hpp"

namespace camdir::paper {

// The face of each triangle of a mesh that bake::triangulate made of `faces`; later stages may have removed
// triangles.
[[nodiscard]] std::vector<std::uint32_t> faces_of(const bake::MedialMesh& mesh,
                                                  const bake::VoronoiFaces& faces);

// One value a vertex of the mesh, rounded down; 0 where no triangle is.
[[nodiscard]] std::vector<float> constant_distances(const bake::MedialMesh& mesh,
                                                    const std::vector<std::uint32_t>& face_of,
                                                    const std::vector<double>& generator_distance, double d0);

}  // namespace camdir::paper
