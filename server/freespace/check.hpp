// Checks on a mesh read from outside: after them no query can leave the arrays, loop or overflow.
#pragma once

#include <string>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

// What is wrong with vertices and triangles, in words, or empty.
[[nodiscard]] std::string find_mesh_flaw(std::span<const Vertex> vertices,
                                         std::span<const Triangle> triangles);

// The same for all of `mesh`. Linear in its size; allocates nothing.
[[nodiscard]] std::string find_flaw(const MeshView& mesh);

}  // namespace camdir::freespace
