// The search for the best slab of a point by the tree of boxes.
#pragma once

#include "freespace/index.hpp"
#include "freespace/slab.hpp"

namespace camdir::freespace {

// Tries every triangle that the index cannot rule out: no slab is better than `best` afterwards by more than
// the share `slack` of it, but for rounding. A good `best` to begin with makes it cheap.
void improve_everywhere(const MeshView& mesh, std::span<const IndexNode> index, const Vec3f& point,
                        float slack, SlabPoint& best);

}  // namespace camdir::freespace
