// A tree of boxes over the triangles, four children a node: the order of a MAP.vfs's triangles, and the index
// that its hints are made by.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

// A child is a subtree or a leaf of at most 4 consecutive triangles.
class IndexChild {
  public:
    static constexpr std::uint32_t leaf_capacity = 4;
    static constexpr std::uint32_t triangle_limit = 1U << 28U;

    [[nodiscard]] static constexpr IndexChild node(std::uint32_t index) { return IndexChild(index); }
    [[nodiscard]] static constexpr IndexChild leaf(std::uint32_t first, std::uint32_t count) {
        return IndexChild(leaf_bit | (first << 3U) | count);
    }
    explicit constexpr IndexChild(std::uint32_t bits) : bits_(bits) {}

    [[nodiscard]] constexpr std::uint32_t bits() const { return bits_; }
    [[nodiscard]] constexpr bool is_leaf() const { return (bits_ & leaf_bit) != 0; }
    [[nodiscard]] constexpr std::uint32_t index() const { return bits_; }
    [[nodiscard]] constexpr std::uint32_t first() const { return (bits_ & ~leaf_bit) >> 3U; }
    [[nodiscard]] constexpr std::uint32_t count() const { return bits_ & 7U; }

  private:
    static constexpr std::uint32_t leaf_bit = 1U << 31U;
    std::uint32_t bits_;
};

// Four children side by side. Nodes are in breadth-first order. An unused child is a leaf of no triangles
// with max_radius = -infinity.
struct alignas(16) IndexNode {
    static constexpr std::uint32_t width = 4;
    struct Boxes {  // [axis][child]
        float low[3][width];
        float high[3][width];
    };

    Boxes box;                // of the triangles below
    Boxes reach;              // of the balls around the corners below, and so of the slabs
    float max_radius[width];  // the largest free distance of a corner below
    std::uint32_t child[width];
};

// Levels of the deepest tree; 13 hold 4^14 triangles.
inline constexpr std::uint32_t index_depth_limit = 13;
static_assert(IndexChild::triangle_limit == 1U << 2U * (index_depth_limit + 1U));

// The order of the triangles that makes a good index, by recursive median splits along the widest of x, y, z
// and free distance: position -> triangle.
[[nodiscard]] std::vector<std::uint32_t> index_order(std::span<const Vertex> vertices,
                                                     std::span<const Triangle> triangles);

// The nodes over the triangles in their present order: correct in any order, fast in index_order's. The
// tree's shape depends only on their number, which must be below triangle_limit. [0] is the root; empty
// without triangles. Linear time.
[[nodiscard]] std::vector<IndexNode> build_index(std::span<const Vertex> vertices,
                                                 std::span<const Triangle> triangles);

}  // namespace camdir::freespace
