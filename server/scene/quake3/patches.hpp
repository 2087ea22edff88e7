// Bezier patches: from control points to triangles.
#pragma once

#include <array>
#include <vector>

#include "base/geometry.hpp"
#include "scene/quake3/bsp.hpp"

namespace camdir::scene::q3 {

// A patch as a grid of points on its surface. Flat triangles over the grid stay within 1 unit of it.
struct Tessellation {
    std::size_t columns;
    std::size_t rows;
    std::vector<Vec3d> points;  // row by row

    // Of one cell, around it.
    [[nodiscard]] std::array<Vec3d, 4> corners(std::size_t column, std::size_t row) const;
    [[nodiscard]] std::size_t triangle_count() const { return 2 * (columns - 1) * (rows - 1); }
    [[nodiscard]] std::vector<std::array<Vec3d, 3>> triangles() const;
};

// `face` is a patch that passed parse_bsp. Fails when more than `max_triangles` would be needed.
[[nodiscard]] Result<Tessellation> tessellate(const Bsp& bsp, const Face& face, std::size_t max_triangles);

}  // namespace camdir::scene::q3
