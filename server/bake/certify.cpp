#include "bake/certify.hpp"

#include <algorithm>
#include <atomic>

#include "bake/geometry/certificate.hpp"
#include "base/round_down.hpp"

namespace camdir::bake {
namespace {

using Radii = std::array<double, 3>;

// The obstacles that the slab may reach into. Lowering its free distances never adds one.
std::vector<std::uint32_t> possibly_violated(const Slab& slab, const Obstacles& obstacles) {
    std::vector<std::uint32_t> found;
    obstacles.tree().visit_where([&](const Box3d& box) { return slab.min_gap(box) < 0.0; },
                                 [&](std::uint32_t position) {
                                     if (slab.min_gap(obstacles.triangles()[position]) < 0.0)
                                         found.push_back(position);
                                 });
    return found;
}

SignedGap worst_of(const Slab& slab, const std::vector<std::uint32_t>& positions,
                   const Obstacles& obstacles) {
    SignedGap worst;
    for (const std::uint32_t position : positions) {
        const Triangle3d& obstacle = obstacles.triangles()[position];
        if (!(slab.min_gap(obstacle) < std::min(0.0, worst.value))) continue;
        const SignedGap gap = slab.signed_gap(obstacle);
        if (gap.value < worst.value) worst = gap;
    }
    return worst;
}

// Lowers the free distances of one triangle until its slab is free: each step projects them onto the
// constraint of the worst point.
Radii certify(const Triangle3d& corners, Radii radii, const Obstacles& obstacles, double tolerance) {
    const std::vector<std::uint32_t> near = possibly_violated(Slab(corners, radii), obstacles);
    constexpr int max_steps = 64;
    for (int step = 0; !near.empty() && step < max_steps; ++step) {
        const SignedGap worst = worst_of(Slab(corners, radii), near, obstacles);
        if (worst.value >= 0.0) break;
        if (worst.value > -tolerance || step + 1 == max_steps) {
            // A ball at any m shrinks by the worst violation, so that none is left.
            for (double& r : radii)
                r += worst.value;
            break;
        }
        // The smallest change, by least squares, that frees the worst point.
        double squares = 0.0;
        for (const double w : worst.weights)
            squares += w * w;
        for (int i = 0; i < 3; ++i)
            radii[i] += worst.value * worst.weights[i] / squares;
    }
    return radii;
}

void lower_to(std::atomic<float>& bound, float value) {
    float current = bound.load(std::memory_order_relaxed);
    while (value < current && !bound.compare_exchange_weak(current, value, std::memory_order_relaxed)) {
    }
}

}  // namespace

// Every triangle finds free distances that make its own slab free; a vertex takes the least of those of its
// triangles. Lower ones keep a slab free, so one pass suffices and its order does not matter.
Result<std::vector<float>> free_distances(const MedialMesh& mesh, const std::vector<double>& clearance,
                                          const Obstacles& obstacles, double tolerance, Stage& stage) {
    std::vector<std::atomic<float>> bounds(mesh.vertices.size());
    for (std::size_t i = 0; i < bounds.size(); ++i)
        bounds[i] = round_down(clearance[i]);
    const bool done = stage.for_each(mesh.triangles.size(), [&](std::uint64_t i) {
        const freespace::Triangle& t = mesh.triangles[i];
        const Radii start{clearance[t.a], clearance[t.b], clearance[t.c]};
        const Radii certified = certify(mesh.corners(t), start, obstacles, tolerance);
        lower_to(bounds[t.a], round_down(certified[0]));
        lower_to(bounds[t.b], round_down(certified[1]));
        lower_to(bounds[t.c], round_down(certified[2]));
    });
    if (!done) return stage.interrupted();
    return std::vector<float>(bounds.begin(), bounds.end());
}

}  // namespace camdir::bake
