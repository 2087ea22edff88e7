// The Delaunay triangulation of the samples, as far as the Voronoi diagram needs it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/stage.hpp"

namespace camdir::bake {

// Samples of one tetrahedron, ascending. Its circumcentre is a Voronoi vertex.
using Cell = std::array<std::uint32_t, 4>;

// Its samples, ascending.
using Edge = std::array<std::uint32_t, 2>;

struct Delaunay {
    std::vector<Cell> cells;  // ascending
    // The cells around each long edge, in order: the corners of its Voronoi face. A ring starts with its
    // smallest cell, and rings with smaller ones come first.
    std::vector<std::uint64_t> ring_begin{0};
    std::vector<std::uint32_t> ring_cells;
    std::vector<Edge> ring_edges;

    [[nodiscard]] std::size_t ring_count() const { return ring_begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> ring(std::size_t i) const {
        return std::span(ring_cells).subspan(ring_begin[i], ring_begin[i + 1] - ring_begin[i]);
    }
};

// Rings only for edges whose Voronoi face is bounded and that are at least as long as the smaller of the
// `min_lengths` of their two samples (one a sample). Exact, also for samples in special position: the result
// depends on nothing but the samples. Fails when all samples lie in one plane; at least 4 are needed.
[[nodiscard]] Result<Delaunay> delaunay(const std::vector<Vec3d>& samples,
                                        const std::vector<double>& min_lengths, Stage& stage);

}  // namespace camdir::bake
