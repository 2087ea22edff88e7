#include "evaluation/verification.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "evaluation/verification_stages.hpp"
#include "freespace/distance.hpp"
#include "freespace/roadmap.hpp"

namespace camdir::evaluation {
namespace {

constexpr double unsafe_depth = 0.02 * metres_of_nominal_unit;  // metres

void verify_spawn_points(const freespace::Freespace& freespace, const scene::Scene& scene,
                         Verification& result) {
    const std::vector<std::uint32_t> component = freespace::roadmap_components(freespace);
    for (std::uint32_t vertex = 0; vertex < component.size(); ++vertex)
        result.components += component[vertex] == vertex ? 1 : 0;
    std::vector<std::uint32_t> entries;
    for (const scene::SpawnPoint& spawn : scene.spawn_points) {
        const freespace::Distance distance = freespace::distance(freespace, spawn.eye.cast<float>());
        if (!distance.covered()) continue;
        // A corner off the roadmap has the component `none`, the largest number.
        const auto& [a, b, c] = freespace.triangles()[distance.triangle];
        entries.push_back(std::min({component[a], component[b], component[c]}));
    }
    result.spawn_points = scene.spawn_points.size();
    result.covered_spawn_points = entries.size();
    for (const std::uint32_t entry : entries) {
        const auto joined = static_cast<std::uint64_t>(std::count(entries.begin(), entries.end(), entry));
        result.joined_spawn_points = std::max(result.joined_spawn_points, joined);
    }
}

}  // namespace

double Coverage::share() const {
    return points > 0 ? static_cast<double>(covered) / static_cast<double>(points)
                      : std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t Verification::unsafe_balls() const {
    return by_area.unsafe_count() + by_triangle.unsafe_count() + at_vertices.unsafe_count() +
           at_edges.unsafe_count();
}

Result<Verification> verify(const freespace::Freespace& freespace, const scene::Scene& scene,
                            const oracle::Oracle& oracle, const VerificationParameters& parameters,
                            const VerificationProgress& progress, const std::stop_token& stop) {
    const auto reachability = oracle::Reachability::explore(oracle, scene, explore_progress(progress), stop);
    if (!reachability) return tl::unexpected(reachability.error());
    const double tolerance = unsafe_depth / scene.metres_per_unit;
    const VerificationJob job{freespace, scene, oracle, *reachability, tolerance, parameters, progress, stop};
    Verification result;
    verify_spawn_points(freespace, scene, result);
    if (auto done = verify_coverage(job, result); !done) return tl::unexpected(std::move(done.error()));
    if (auto done = verify_balls(job, result); !done) return tl::unexpected(std::move(done.error()));
    return result;
}

}  // namespace camdir::evaluation
