// Checks on a mesh read from outside: after them no query can leave the arrays, loop or overflow.
#pragma once

#include <string>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

// What is wrong with vertices and triangles, in words, or empty.
[[nodiscard]] std::string find_mesh_flaw(std::span<const Vertex> vertices,
                                         std::span<const Triangle> triangles);

// The same of the hints for a mesh of so many triangles.
[[nodiscard]] std::string find_hints_flaw(const HintGrid& hints, std::size_t triangle_count);

}  // namespace camdir::freespace
