// Slabs prepared for queries: each triangle in the coordinates of its own plane, where the best point of a
// slab (slab.hpp) takes few operations.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

// x runs from corner a along the longest edge ab, y towards c, h along the normal. Rows of four, as the
// queries load them.
struct alignas(32) SlabFrame {
    float origin[3], radius_a;  // corner a and its free distance
    float along[3], length;     // unit vector of ab; its length
    float normal[3], c_x;
    float c_y, gradient_x, gradient_y;  // of the free distance
    float fall;          // sqrt(1 - gradient^2), or infinity: no best point in the triangle's interior
    float inverse_fall;  // 1 / fall
    // How far uphill of its foot the best point of an edge lies, for a point at distance 1 from the edge's
    // line: in map units along ab, in shares of the edge along ac and bc.
    float uphill_ab, uphill_ac, uphill_bc;
    float rise_ac, rise_bc;          // of the free distance over the whole edge
    float inverse_ac2, inverse_bc2;  // 1 / length^2; infinity for an edge without length
};

struct SlabFrames {
    std::vector<SlabFrame> frames;  // of each triangle
    std::vector<Triangle> corners;  // its corners a, b, c in the frame
};

// Linear time. The mesh must be free of flaws (check.hpp).
[[nodiscard]] SlabFrames build_frames(std::span<const Vertex> vertices, std::span<const Triangle> triangles);

}  // namespace camdir::freespace
