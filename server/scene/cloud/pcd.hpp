// PCD, the Point Cloud Library's format, version 0.6 and 0.7: ascii, binary and binary_compressed (LZF).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"

namespace camdir::scene {

// The text starts with comments and the word VERSION or FIELDS.
[[nodiscard]] bool is_pcd(std::span<const std::byte> bytes);

// Points in the file's order, including those without a position (NaN). Errors name the line or the byte.
[[nodiscard]] Result<std::vector<Vec3d>> read_pcd(std::span<const std::byte> bytes);

}  // namespace camdir::scene
