// Checks on what is read from outside: after them no query can leave the arrays, loop or overflow.
#pragma once

#include <string>

#include "freespace/freespace.hpp"
#include "freespace/hints.hpp"

namespace camdir::freespace {

// The checks return what is wrong, in words, or an empty string.

// Files hold fewer counts than this.
inline constexpr std::uint32_t count_limit = 10'000;

// Bytes of a mover's name and kind.
inline constexpr std::size_t max_mover_name = 64;

[[nodiscard]] std::string find_metadata_flaw(const Metadata& metadata,
                                             std::span<const SpawnPoint> spawn_points);
[[nodiscard]] std::string find_mesh_flaw(std::span<const Vertex> vertices,
                                         std::span<const Triangle> triangles);

// Not checked: that a hull is bounded, and that its box encloses it.
[[nodiscard]] std::string find_movers_flaw(std::span<const MoverShape> movers);

[[nodiscard]] std::string find_fixed_shots_flaw(std::span<const FixedShot> shots,
                                                std::size_t spawn_point_count);

// Of the box that a file states around its vertices.
[[nodiscard]] std::string find_bounds_flaw(const Box3f& bounds, std::span<const Vertex> vertices);

// Of the hints for a mesh of so many triangles.
[[nodiscard]] std::string find_hints_flaw(const HintView& hints, std::size_t triangle_count);

}  // namespace camdir::freespace
