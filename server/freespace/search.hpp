// The search for the best slab of a point: around a known slab, or by the index.
#pragma once

#include "freespace/slab.hpp"

namespace camdir::freespace {

// Tries `triangle` and every triangle that shares a vertex with it.
void improve_by_ring(const Freespace& freespace, const Vec3f& point, std::uint32_t triangle, SlabPoint& best);

// Tries every triangle that the index cannot rule out: afterwards no slab is better than `best`, but for
// rounding. A good `best` to begin with makes it cheap.
void improve_everywhere(const MeshView& mesh, const Vec3f& point, SlabPoint& best);

}  // namespace camdir::freespace
