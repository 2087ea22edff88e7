// The Delaunay triangulation of the samples, reduced to what the Voronoi diagram needs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/stage.hpp"

namespace camdir::bake {

// Samples of one tetrahedron, ascending. Its circumcentre is a Voronoi vertex.
using Cell = std::array<std::uint32_t, 4>;

// The two samples between which a Voronoi face lies, ascending.
using Generators = std::array<std::uint32_t, 2>;

struct Delaunay {
    std::vector<Cell> cells;  // ascending
    // Voronoi faces: the cells around each long edge, in order, are the corners of its face. A face starts
    // with its smallest cell; faces are ascending by that.
    std::vector<std::uint64_t> face_begin{0};
    std::vector<std::uint32_t> face_cells;
    std::vector<Generators> generators;  // of each face

    [[nodiscard]] std::size_t face_count() const { return face_begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t i) const {
        return std::span(face_cells).subspan(face_begin[i], face_begin[i + 1] - face_begin[i]);
    }
};

// Faces only of edges whose Voronoi face is bounded and that are at least as long as the smaller of the
// `min_lengths` of their two samples (one per sample). Predicates are exact, also for samples in special
// position: the result depends on the samples alone. Needs at least 4 samples; fails when all lie in one
// plane.
[[nodiscard]] Result<Delaunay> delaunay(const std::vector<Vec3d>& samples,
                                        const std::vector<double>& min_lengths, Stage& stage);

}  // namespace camdir::bake
