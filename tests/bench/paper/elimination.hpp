// How one vertex would be eliminated: the swaps of section 4.3, tried on a copy of its surroundings.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bench/paper/dynamic_mesh.hpp"

namespace camdir::paper {

struct Elimination {
    double lost_volume = 0.0;
    std::vector<Corners> triangles;                         // in place of the star
    std::vector<std::pair<std::uint32_t, double>> lowered;  // free distances around
};

// None when this kind of vertex cannot be eliminated (those on a seam only with `seams`), or when swapping
// the cheapest edge first gets stuck.
[[nodiscard]] std::optional<Elimination> plan_elimination(const DynamicMesh& mesh, std::uint32_t vertex,
                                                          bool seams);

}  // namespace camdir::paper
