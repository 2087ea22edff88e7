// Which triangles have a vertex as a corner.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

struct Incidence {
    std::vector<std::uint32_t> offsets;    // one a vertex and one more: where its triangles begin
    std::vector<std::uint32_t> triangles;  // of each vertex, ascending
};

// Linear time. Every index must be below `vertex_count`.
[[nodiscard]] Incidence build_incidence(std::size_t vertex_count, std::span<const Triangle> triangles);

}  // namespace camdir::freespace
