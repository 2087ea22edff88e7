// What surrounds a vertex of the medial mesh: the link, cut into fans.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace camdir::paper {

// Vertices around the centre in order; triangles are the centre with each two that follow each other.
using Fan = std::vector<std::uint32_t>;

// A vertex without non-manifold edges and off the border: one fan, closed. On a seam where sheets meet: one
// open fan a sheet, three or more, all from the same vertex to the same vertex, the only non-manifold edges.
struct Surroundings {
    std::vector<Fan> fans;
    bool closed = false;
};

// From the edges opposite to the vertex in its triangles. None for vertices of any other kind.
[[nodiscard]] std::optional<Surroundings> surroundings(
    const std::vector<std::pair<std::uint32_t, std::uint32_t>>& link);

}  // namespace camdir::paper
