// Bezier patches: from control points to triangles.
#pragma once

#include <array>
#include <vector>

#include "base/geometry.hpp"
#include "scene/quake3/bsp.hpp"

namespace camdir::scene::q3 {

// A patch as a grid of points on its surface; flat triangles over the grid are within 1 unit of it. Chords
// are at most 0.4 units off the curves along each direction, which follows from the control points; the whole
// distance, with the twist of cells, is checked at the middle of every cell. What checks a bake against these
// triangles does not see this deviation. The game is coarser: it draws curves within 4 units.
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
