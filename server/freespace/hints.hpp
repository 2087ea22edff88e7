// The grid of hints: the triangle to try first at a point.
#pragma once

#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

struct Hints {
    float cell_size = 1.0F;
    std::array<std::uint32_t, 3> extent{};
    std::vector<std::uint32_t> triangles;
};

// A grid over `bounds` of about one cell per triangle, and at least about 1,024. Needs the mesh's index.
[[nodiscard]] Hints build_hints(const MeshView& mesh, const Box3f& bounds);

}  // namespace camdir::freespace
