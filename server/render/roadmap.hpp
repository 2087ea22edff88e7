// The roadmap as line segments: the paper's section 5.3.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::render {

// Two vertices of V(S), the smaller number first.
using Edge = std::array<std::uint32_t, 2>;

// Every edge of V(S) whose whole length lies in freespace (both ends have d_f > 0), once, ascending.
[[nodiscard]] std::vector<Edge> roadmap_edges(const freespace::Freespace& freespace);

}  // namespace camdir::render
