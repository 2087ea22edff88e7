// PLY point clouds: ascii, binary_little_endian and binary_big_endian. PLY meshes are the mesh reader's.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"

namespace camdir::scene {

[[nodiscard]] bool is_ply(std::span<const std::byte> bytes);

// The header promises faces or triangle strips: how many, 0 for a point cloud.
[[nodiscard]] Result<std::uint64_t> ply_face_count(std::span<const std::byte> bytes);

// The positions of the element `vertex`, in the file's order. Errors name the line or the byte.
[[nodiscard]] Result<std::vector<Vec3d>> read_ply_points(std::span<const std::byte> bytes);

}  // namespace camdir::scene
