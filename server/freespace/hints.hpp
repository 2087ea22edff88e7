// The grid of hints in a MAP.vfs: a good slab for the centre of each cell. The queries have an index of their
// own; the hints are written and checked because the format holds them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "freespace/freespace.hpp"
#include "freespace/index.hpp"

namespace camdir::freespace {

struct Hints {
    float cell_size = 1.0F;
    std::array<std::uint32_t, 3> extent{};
    std::vector<std::uint32_t> triangles;
};

// The same as a file holds them.
struct HintView {
    float cell_size = 1.0F;
    std::array<std::uint32_t, 3> extent{};     // cells along x, y, z
    std::span<const std::uint32_t> triangles;  // x fastest: a slab that covers the cell's centre, or none
};

// A grid over `bounds` of about one cell per triangle, and at least about 1,024. `index` is the mesh's.
[[nodiscard]] Hints build_hints(const MeshView& mesh, std::span<const IndexNode> index, const Box3f& bounds);

}  // namespace camdir::freespace
