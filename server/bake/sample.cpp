#include "bake/sample.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

namespace camdir::bake {
namespace {

// Refines obstacle triangles; one object for all threads.
class Refinement {
  public:
    Refinement(const Solids& solids, const SamplingDistance& distance, double slack, std::uint64_t limit,
               const Stage& stage)
        : solids_(solids), distance_(distance), slack_(slack), limit_(limit), stage_(stage) {}

    // Bisects longest edges until the triangles are fine enough, and collects the midpoints. Ends early when
    // there are too many in all, or when the stage must end. False when the triangle needs no samples.
    bool sample(const Triangle3d& t, std::vector<Vec3d>& midpoints) {
        if (is_buried(t)) return false;
        if (total_ <= limit_)
            refine(t, {distance_.at(t[0]), distance_.at(t[1]), distance_.at(t[2])}, midpoints);
        total_ += midpoints.size() % block;
        return true;
    }

  private:
    void refine(const Triangle3d& t, const std::array<double, 3>& at, std::vector<Vec3d>& midpoints) {
        const int from = longest_edge(t);
        const int to = (from + 1) % 3;
        const int apex = (from + 2) % 3;
        const double max_radius = distance_.covering(std::min({at[0], at[1], at[2]})) - slack_;
        const double length2 = (t[to] - t[from]).squaredNorm();
        if (length2 < 4.0 * max_radius * max_radius && covering_radius(t) < max_radius) return;
        if (stage_.stopping() || too_many(midpoints.size())) return;
        // The sum commutes exactly, so both triangles of a shared edge get the same point.
        const Vec3d middle = 0.5 * (t[from] + t[to]);
        const double at_middle = distance_.at(middle);
        midpoints.push_back(middle);
        const Triangle3d first{t[from], middle, t[apex]};
        const Triangle3d second{middle, t[to], t[apex]};
        if (!is_buried(first)) refine(first, {at[from], at_middle, at[apex]}, midpoints);
        if (!is_buried(second)) refine(second, {at_middle, at[to], at[apex]}, midpoints);
    }

    // Gaps as narrow as rounding makes them count as closed.
    [[nodiscard]] bool is_buried(const Triangle3d& t) const {
        return solids_.is_buried(t, 0.001 * distance_.finest());
    }

    // Counts in blocks: the counter is shared by all threads.
    bool too_many(std::size_t of_one_triangle) {
        if (of_one_triangle > 0 && of_one_triangle % block == 0) total_ += block;
        return total_ > limit_;
    }

    static constexpr std::uint64_t block = 1024;

    const Solids& solids_;
    const SamplingDistance& distance_;
    const double slack_;
    const std::uint64_t limit_;
    const Stage& stage_;
    std::atomic<std::uint64_t> total_ = 0;
};

// The corners of the triangles that need samples, each once.
std::vector<Vec3d> corners_of(const scene::Scene& scene, const std::vector<char>& needs) {
    std::vector<char> is_corner(scene.vertices.size());
    for (std::size_t i = 0; i < needs.size(); ++i)
        for (const std::uint32_t vertex : scene.triangles[i])
            is_corner[vertex] |= needs[i];
    std::vector<Vec3d> corners;
    for (std::size_t vertex = 0; vertex < is_corner.size(); ++vertex)
        if (is_corner[vertex] != 0) corners.push_back(scene.vertices[vertex]);
    return corners;
}

}  // namespace

tl::unexpected<Error> too_many_samples(const scene::Scene& scene, double distance, double at_least) {
    const auto millions = static_cast<std::uint64_t>(std::min(at_least / 1e6, 1e12));
    return fail(scene.source + ": a sampling distance of " + std::to_string(distance) +
                " map units needs more than " + std::to_string(millions) +
                " million samples, and the limit is " + std::to_string(max_samples / 1'000'000U) +
                " million; choose a larger d0, or say with --metres-per-unit how long a unit is");
}

double covering_radius(const Triangle3d& t) {
    const int from = longest_edge(t);
    const Vec3d& a = t[from];
    const Vec3d& b = t[(from + 1) % 3];
    const Vec3d& apex = t[(from + 2) % 3];
    const double length = (b - a).norm();
    if (length == 0.0) return 0.0;
    const Vec3d along = (b - a) / length;
    const Vec3d to_a = a - apex;
    const Vec3d to_b = b - apex;
    if (to_a.dot(to_b) >= 0.0) {
        // Not obtuse: the circumcentre lies inside. Without area the apex lies on an end.
        const double twice_area = to_a.cross(to_b).norm();
        if (twice_area == 0.0) return 0.5 * length;
        return to_a.norm() * to_b.norm() * length / (2.0 * twice_area);
    }
    // Obtuse: on the longest edge, where the cells of its ends meet the apex's cell.
    const double from_a = to_a.squaredNorm() / (-2.0 * to_a.dot(along));
    const double from_b = to_b.squaredNorm() / (2.0 * to_b.dot(along));
    return std::max(from_a, from_b);
}

Result<void> check_sample_count(const scene::Scene& scene, double coarsest, double finest) {
    double discs = 0.0;  // a sample covers at most one
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        discs += area(scene::corners(scene, i)) / (M_PI * coarsest * coarsest);
    if (discs > static_cast<double>(max_samples)) return too_many_samples(scene, finest, discs);
    return {};
}

Result<std::vector<Vec3d>> sample(const scene::Scene& scene, const Solids& solids,
                                  const SamplingDistance& distance, double slack, Stage& stage,
                                  std::uint64_t limit) {
    Refinement refinement(solids, distance, slack, limit, stage);
    std::vector<std::vector<Vec3d>> midpoints_of(scene.triangles.size());
    std::vector<char> needs(scene.triangles.size());
    const bool done = stage.for_each(scene.triangles.size(), [&](std::uint64_t i) {
        needs[i] = refinement.sample(scene::corners(scene, i), midpoints_of[i]);
    });
    if (!done) return stage.interrupted();
    std::vector<Vec3d> samples = corners_of(scene, needs);
    std::size_t total = samples.size();
    for (const auto& of_one : midpoints_of)
        total += of_one.size();
    if (total > limit) return too_many_samples(scene, distance.finest(), static_cast<double>(limit));
    samples.reserve(total);
    for (const auto& of_one : midpoints_of)
        samples.insert(samples.end(), of_one.begin(), of_one.end());
    stage.count("triangles", static_cast<double>(scene.triangles.size()));
    stage.count("points", static_cast<double>(samples.size()));
    return samples;
}

Result<std::vector<double>> distances_at(const std::vector<Vec3d>& samples, const SamplingDistance& distance,
                                         Stage& stage) {
    std::vector<double> distances(samples.size());
    const bool done =
        stage.for_each(samples.size(), [&](std::uint64_t i) { distances[i] = distance.at(samples[i]); });
    if (!done) return stage.interrupted();
    return distances;
}

}  // namespace camdir::bake
