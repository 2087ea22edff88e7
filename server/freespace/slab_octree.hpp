// The spatial index of the queries: which slabs can be the best one somewhere in a cell of space.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "freespace/slab.hpp"
#include "freespace/slab_kernel.hpp"

namespace camdir::freespace {

// An octree over the space that slabs reach. A leaf lists every slab whose value (slab.hpp) is positive and
// the largest of all somewhere in its cell, and few others. Each comes with an upper bound of its value at
// every point of the cell, so that a query looks up a cell and evaluates a handful of slabs. The upper levels
// are a grid.
//
// Immutable; refers to the vertices that it was built over.
class SlabOctree {
  public:
    // Over the space that no slab reaches.
    SlabOctree() = default;

    // Cells are halved down to `smallest_cell` (map units, > 0), where lists are long. Work and memory are
    // linear in the number of triangles. The mesh must be free of flaws (check.hpp).
    SlabOctree(std::span<const Vertex> vertices, std::span<const Triangle> triangles, float smallest_cell);

    // The slab with the largest value at a finite point, but for rounding; of equal slabs always the same.
    // `triangle` is none when no slab has a value above `least` >= 0.
    [[nodiscard]] SlabPoint best(const Vec3f& point, float least = 0.0F) const;

    // The ball around a point that best() gave.
    [[nodiscard]] Ball ball(const SlabPoint& point) const;

    [[nodiscard]] std::size_t memory() const;  // bytes

  private:
    friend class SlabOctreeBuilder;

    // Either the first of eight children in nodes_, or a leaf: the place of its list in lists_, in
    // list_units.
    using Node = std::uint32_t;
    static constexpr Node leaf_bit = 1U << 31U;
    static constexpr Node empty_leaf = none;
    static constexpr std::size_t list_unit = 8;

    // A list is a head and its quads. A slab's value at `way` from the cell's centre is at most
    // top - drop * drop_unit * half + way.dot(slope) / slope_unit.
    struct ListHead {
        float centre[3];  // of the cell
        float half;       // of its width
        float top;
        std::uint32_t quads;
    };
    struct Quad {
        std::int8_t bounds[4][lane_count];  // drop - 128, slope along x, y, z
        FourSlabs slabs;                    // filled up by repetition
    };
    static constexpr float drop_unit = 5.3F / 255.0F;
    static constexpr float slope_unit = 127.0F;

    // The leaf that holds the point; empty_leaf outside of all.
    [[nodiscard]] Node leaf_at(const Vec3f& point) const;

    std::span<const Vertex> vertices_;
    SlabFrames frames_;
    Vec3f origin_ = Vec3f::Zero();           // smallest corner of the grid
    float smallest_ = 1.0F;                  // width of the smallest cells
    float cells_per_unit_ = 1.0F;            // of these
    int grid_shift_ = 0;                     // a grid cell has 2^grid_shift smallest cells along each axis
    std::array<std::uint32_t, 3> extent_{};  // of the grid, in smallest cells
    std::vector<Node> grid_;                 // x fastest
    std::vector<Node> nodes_;                // in eights, by octant: bit 0 of x, bit 1 of y, bit 2 of z
    std::vector<std::byte> lists_;           // each a ListHead and its Quads
};

}  // namespace camdir::freespace
