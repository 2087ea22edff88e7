// LAS 1.0 to 1.4, the laser scanners' format, uncompressed.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"

namespace camdir::scene {

[[nodiscard]] bool is_las(std::span<const std::byte> bytes);

// Points in the file's order. Refuses LAZ by name. Errors name the byte.
[[nodiscard]] Result<std::vector<Vec3d>> read_las(std::span<const std::byte> bytes);

}  // namespace camdir::scene
