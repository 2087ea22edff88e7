// Divides the medial mesh into regions that are reduced in parallel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::bake {

// Lists of at most `max_size` vertices, ascending: bisects each box along its longest side at `fraction`
// (above 1 / `max_size`, below 1) of its count. Depends on the input alone; another `fraction` puts the
// borders elsewhere.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> make_regions(std::span<const Vec3f> positions,
                                                                   std::span<const std::uint32_t> chosen,
                                                                   std::size_t max_size, double fraction);

}  // namespace camdir::bake
