// The Voronoi faces of section 4.2, steps 1 and 2, by either engine, with what the paper's free distance
// needs to know of them.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/voronoi.hpp"
#include "bench/paper/stopwatch.hpp"

namespace camdir::paper {

struct Faces {
    bake::VoronoiFaces faces;
    std::vector<double> generator_distance;  // of each face: |p2 - p1| of the samples that induce it
    std::uint64_t voronoi_vertices = 0;      // of the whole diagram
    Cost diagram;                            // of the diagram without reading its faces
};

// Bounded faces inside `bounds` whose samples are `min_distance` or more apart. qhull lifts the samples to
// the paraboloid as the paper does; samples that it cannot tell apart from cospherical ones share a vertex.
[[nodiscard]] Result<Faces> voronoi_by_qhull(const std::vector<Vec3d>& samples, double min_distance,
                                             const Box3d& bounds);

// The same by the baker's own stages; vertices nearer than `weld_distance` become one.
[[nodiscard]] Result<Faces> voronoi_by_cgal(const std::vector<Vec3d>& samples, double min_distance,
                                            const Box3d& bounds, double weld_distance);

}  // namespace camdir::paper
