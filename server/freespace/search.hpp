// The search for the best slab of a point: around a known slab, or by the index.
#pragma once

#include "freespace/slab.hpp"

namespace camdir::freespace {

// Tries the hint for the point, and `previous` if it is a triangle of the mesh.
void improve_by_hints(const MeshView& mesh, const Vec3f& point, std::uint32_t previous, SlabPoint& best);

// Tries the hints of the eight cells nearest to the point.
void improve_by_hints_around(const MeshView& mesh, const Vec3f& point, SlabPoint& best);

// Tries `triangle` and every triangle that shares a vertex with it.
void improve_by_ring(const Freespace& freespace, const Vec3f& point, std::uint32_t triangle, SlabPoint& best);

// When a search by the index may end early. A best value of at most `enough` is searched for completely.
struct Effort {
    float enough = -std::numeric_limits<float>::infinity();
    float slack = 0.0F;                 // no slab need be better than the best by more than this share of it
    std::uint32_t leaves = 0xffffffff;  // to look into, the most promising first
};

// Tries every triangle that the index cannot rule out: with unlimited effort no slab is better than `best`
// afterwards, but for rounding. A good `best` to begin with makes it cheap.
void improve_everywhere(const MeshView& mesh, const Vec3f& point, const Effort& effort, SlabPoint& best);

}  // namespace camdir::freespace
