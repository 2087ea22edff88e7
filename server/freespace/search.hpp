// The search for the best slab of a point: around a known slab, or by the index.
#pragma once

#include "freespace/slab.hpp"

namespace camdir::freespace {

// Tries the hint for the point and `previous`, when it is a triangle of the mesh.
void improve_by_hints(const MeshView& mesh, const Vec3f& point, std::uint32_t previous, SlabPoint& best);

// Tries `triangle` and every triangle that shares a vertex with it.
void improve_by_ring(const Freespace& freespace, const Vec3f& point, std::uint32_t triangle, SlabPoint& best);

// Tries every triangle that the index cannot rule out: afterwards no slab is better than best.value by more
// than the share `slack` of it, but for rounding. A good `best` to begin with and a slack make it cheap.
void improve_everywhere(const MeshView& mesh, const Vec3f& point, float slack, SlabPoint& best);

}  // namespace camdir::freespace
