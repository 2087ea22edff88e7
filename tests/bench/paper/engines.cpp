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

}  // namespace

Result<EngineCost> measure_engine(Engine engine, const scene::Scene& scene, double d0, int runs) {
    const double unit = metres_of_nominal_unit / scene.metres_per_unit;
    const double distance = 2.0 * d0 * unit;
    const auto samples = sample(scene, d0 * unit);
    if (!samples) return tl::unexpected(samples.error());
    EngineCost best{samples->size(), {unmeasured, unmeasured}, {unmeasured, unmeasured}};
    for (int i = 0; i < runs; ++i) {
        Stopwatch stopwatch;
        const Result<Faces> faces = tbb::task_arena(1).execute([&] {
            return engine == Engine::qhull ? voronoi_by_qhull(*samples, distance, scene.bounds)
                                           : voronoi_by_cgal(*samples, distance, scene.bounds, 0.01 * unit);
        });
        if (!faces) return tl::unexpected(faces.error());
        lower_to(best.faces, stopwatch.lap());
        lower_to(best.diagram, faces->diagram);
    }
    return best;
}

}  // namespace camdir::paper
