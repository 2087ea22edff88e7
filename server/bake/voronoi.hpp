// The Voronoi faces that approximate the medial surface: steps 1 and 2 of the paper's section 4.2.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bake/delaunay.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// Polygons over shared vertices, convex and planar but for merged vertices, which may also repeat in one.
struct VoronoiFaces {
    std::vector<Vec3d> vertices;
    std::vector<std::uint64_t> begin{0};
    std::vector<std::uint32_t> corners;
    std::vector<Generators> generators;  // of each face

    [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t i) const {
        return std::span(corners).subspan(begin[i], begin[i + 1] - begin[i]);
    }
};

// The faces that lie inside `bounds`. Neighbouring Voronoi vertices nearer to each other than
// `merge_distance` become one, and none moves further than that: samples in regular grids have clusters of
// cells with one circumcentre.
[[nodiscard]] Result<VoronoiFaces> voronoi_faces(const std::vector<Vec3d>& samples, const Delaunay& delaunay,
                                                 const Box3d& bounds, double merge_distance, Stage& stage);

}  // namespace camdir::bake
