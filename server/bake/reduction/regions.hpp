// Cuts the medial mesh into regions that can be worked on in parallel.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::bake {

// Vertex lists of at most `most` vertices, cut at `cut` (above 1 / `most`, below 1) of each box's count along
// its longest side. Depends on the input alone; another `cut` puts the borders elsewhere. Lists are
// ascending.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> make_regions(std::span<const Vec3f> positions,
                                                                   std::span<const std::uint32_t> chosen,
                                                                   std::size_t most, double cut);

}  // namespace camdir::bake
