#include "bench/paper/voronoi.hpp"

#include "bake/delaunay.hpp"

namespace camdir::paper {

Result<Faces> voronoi_by_cgal(const std::vector<Vec3d>& samples, double min_distance, const Box3d& bounds,
                              double weld_distance) {
    Stopwatch stopwatch;
    bake::Stage stage("voronoi", {}, {});
    const auto delaunay = bake::delaunay(samples, std::vector<double>(samples.size(), min_distance), stage);
    if (!delaunay) return tl::unexpected(delaunay.error());
    const Cost diagram = stopwatch.lap();
    auto faces = bake::voronoi_faces(samples, *delaunay, bounds, weld_distance, stage);
    if (!faces) return tl::unexpected(faces.error());

    Faces result;
    result.faces = std::move(*faces);
    result.voronoi_vertices = delaunay->cells.size();
    result.diagram = diagram;
    for (const auto& [a, b] : result.faces.generators)
        result.generator_distance.push_back((samples[a] - samples[b]).norm());
    return result;
}

}  // namespace camdir::paper
