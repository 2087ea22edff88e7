#include "bench/paper/engines.hpp"

#include <tbb/task_arena.h>

#include <limits>

#include "bench/paper/sampling.hpp"
#include "bench/paper/voronoi.hpp"

namespace camdir::paper {
namespace {

constexpr double unmeasured = std::numeric_limits<double>::infinity();

void lower_to(Cost& best, const Cost& cost) {
    best.seconds = std::min(best.seconds, cost.seconds);
    best.cpu_seconds = std::min(best.cpu_seconds, cost.cpu_seconds);
}

template <class Voronoi>
Result<EngineCost> best_of(int runs, const Voronoi& voronoi) {
    EngineCost best{{unmeasured, unmeasured}, {unmeasured, unmeasured}};
    for (int i = 0; i < runs; ++i) {
        Stopwatch stopwatch;
        const Result<Faces> faces = voronoi();
        if (!faces) return tl::unexpected(faces.error());
        lower_to(best.faces, stopwatch.lap());
        lower_to(best.diagram, faces->diagram);
    }
    return best;
}

}  // namespace

Result<Engines> compare_engines(const scene::Scene& scene, double d0, int runs) {
    const double unit = 0.0254 / scene.metres_per_unit;
    const double distance = 2.0 * d0 * unit;
    const auto samples = sample(scene, d0 * unit);
    if (!samples) return tl::unexpected(samples.error());
    const auto qhull = best_of(runs, [&] { return voronoi_by_qhull(*samples, distance, scene.bounds); });
    if (!qhull) return tl::unexpected(qhull.error());
    const auto cgal = best_of(runs, [&] {
        return tbb::task_arena(1).execute(
            [&] { return voronoi_by_cgal(*samples, distance, scene.bounds, 0.01 * unit); });
    });
    if (!cgal) return tl::unexpected(cgal.error());
    return Engines{samples->size(), *qhull, *cgal};
}

}  // namespace camdir::paper
