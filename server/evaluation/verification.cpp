#include "evaluation/verification.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "evaluation/verify_balls.hpp"
#include "evaluation/verify_coverage.hpp"
#include "freespace/distance.hpp"

namespace camdir::evaluation {
namespace {

constexpr double unsafe_depth = 0.02 * 0.0254;  // metres

// Components of the roadmap: vertices joined by edges whose whole length is free.
class Components {
  public:
    explicit Components(const freespace::Freespace& freespace)
        : freespace_(freespace), parents_(freespace.vertices().size()) {
        std::iota(parents_.begin(), parents_.end(), 0U);
        for (const auto& [a, b, c] : freespace.triangles()) {
            join(a, b);
            join(b, c);
            join(c, a);
        }
    }

    // The component of a slab's free corners; `none` when it has none.
    [[nodiscard]] std::uint32_t of_triangle(std::uint32_t triangle) {
        const auto& [a, b, c] = freespace_.triangles()[triangle];
        for (const std::uint32_t vertex : {a, b, c}) {
            if (is_free(vertex)) return root(vertex);
        }
        return freespace::none;
    }

    // Those with a free vertex.
    [[nodiscard]] std::uint64_t count() const {
        std::uint64_t count = 0;
        for (std::uint32_t vertex = 0; vertex < parents_.size(); ++vertex)
            if (parents_[vertex] == vertex && is_free(vertex)) ++count;
        return count;
    }

  private:
    [[nodiscard]] bool is_free(std::uint32_t vertex) const {
        return freespace_.vertices()[vertex].free_distance > 0.0F;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        if (is_free(a) && is_free(b)) parents_[root(a)] = root(b);
    }
    [[nodiscard]] std::uint32_t root(std::uint32_t vertex) {
        while (parents_[vertex] != vertex) {
            parents_[vertex] = parents_[parents_[vertex]];
            vertex = parents_[vertex];
        }
        return vertex;
    }

    const freespace::Freespace& freespace_;
    std::vector<std::uint32_t> parents_;
};

void verify_spawn_points(const freespace::Freespace& freespace, const scene::Scene& scene,
                         Verification& result) {
    Components components(freespace);
    result.components = components.count();
    std::vector<std::uint32_t> entries;
    for (const scene::SpawnPoint& spawn : scene.spawn_points) {
        const freespace::Distance distance =
            freespace::distance_everywhere(freespace, spawn.eye.cast<float>());
        if (distance.covered()) entries.push_back(components.of_triangle(distance.triangle));
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
    const double tolerance = unsafe_depth / scene.metres_per_unit;
    Verification result;
    verify_spawn_points(freespace, scene, result);
    const Result<void> covered =
        verify_coverage(freespace, scene, oracle, tolerance, parameters, progress, stop, result);
    if (!covered) return tl::unexpected(covered.error());
    verify_balls(freespace, oracle, tolerance, parameters, progress, stop, result);
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    return result;
}

}  // namespace camdir::evaluation
