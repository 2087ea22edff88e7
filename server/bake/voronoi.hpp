// The Voronoi faces that approximate the medial surface: steps 1 and 2 of the paper's section 4.2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/delaunay.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// Polygons over shared vertices, convex and plane up to the weld; corners of one may repeat after it.
struct VoronoiFaces {
    std::vector<Vec3d> vertices;
    std::vector<std::uint64_t> begin{0};
    std::vector<std::uint32_t> corners;
    std::vector<Edge> edges;  // of each face: the samples that it lies between

    [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t i) const {
        return std::span(corners).subspan(begin[i], begin[i + 1] - begin[i]);
    }
};

// The duals of the rings, as far as they lie inside `bounds`. Neighbouring Voronoi vertices nearer to each
// other than `weld_distance` become one, none moved further than that: samples in regular grids have clusters
// of cells with one circumcentre.
[[nodiscard]] Result<VoronoiFaces> voronoi_faces(const std::vector<Vec3d>& samples, const Delaunay& delaunay,
                                                 const Box3d& bounds, double weld_distance, Stage& stage);

}  // namespace camdir::bake
