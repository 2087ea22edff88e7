#include "bench/paper/voronoi.hpp"

#include <algorithm>

#include "bake/delaunay.hpp"

namespace camdir::paper {
namespace {

// The two samples that all cells around an edge have in common: its ends.
double edge_length(const bake::Delaunay& delaunay, std::uint32_t ring, const std::vector<Vec3d>& samples) {
    const auto cells = delaunay.ring(ring);
    const bake::Cell& first = delaunay.cells[cells.front()];
    std::vector<std::uint32_t> common(first.begin(), first.end());
    for (const std::uint32_t cell : cells) {
        std::erase_if(common, [&](std::uint32_t sample) {
            const bake::Cell& other = delaunay.cells[cell];
            return std::find(other.begin(), other.end(), sample) == other.end();
        });
    }
    return (samples[common[1]] - samples[common[0]]).norm();
}

}  // namespace

Result<Faces> voronoi_by_cgal(const std::vector<Vec3d>& samples, double min_distance, const Box3d& bounds,
                              double weld_distance) {
    Stopwatch stopwatch;
    bake::Stage stage("voronoi", {}, {});
    const auto delaunay =
        bake::delaunay(samples, std::vector<double>(samples.size(), 0.5 * min_distance), stage);
    if (!delaunay) return tl::unexpected(delaunay.error());
    const Cost diagram = stopwatch.lap();
    auto faces = bake::voronoi_faces(samples, *delaunay, bounds, weld_distance, stage);
    if (!faces) return tl::unexpected(faces.error());

    Faces result;
    result.faces = std::move(*faces);
    result.voronoi_vertices = delaunay->cells.size();
    result.diagram = diagram;
    for (const std::uint32_t ring : result.faces.rings)
        result.generator_distance.push_back(edge_length(*delaunay, ring, samples));
    return result;
}

}  // namespace camdir::paper
