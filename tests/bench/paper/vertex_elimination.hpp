// The paper's mesh reduction (section 4.3): vertices are eliminated by edge swaps.
#pragma once

#include <vector>

#include "bake/medial_mesh.hpp"

namespace camdir::paper {

// Eliminates vertices, those first that lose the least volume of freespace, as long as one loses less than
// `threshold` (map units cubed): swaps edges at the vertex until three triangles (two a sheet on a seam) are
// left, which become one. First the vertices with manifold neighbourhoods, at the end those on seams where
// three or more sheets meet along two edges. Border vertices stay.
//
// No vertex is new, and the new freespace lies inside the old one: a swap maps the new edge's point nearest
// to the old edge to the old edge's point nearest to it, and lowers the free distances at the new edge's ends
// until the ball there fits into the old one. The volume of a triangle's freespace is taken as
// twice the integral of its free distance: balls that neighbours share are left out on both sides.
//
// Vertices keep their indices; those eliminated are in no triangle.
void eliminate_vertices(bake::MedialMesh& mesh, std::vector<float>& free_distance, double threshold);

}  // namespace camdir::paper
