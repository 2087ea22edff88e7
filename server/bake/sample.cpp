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
    Refinement(const Solids& solids, const SamplingDistance& distance, double slack, const Stage& stage)
        : solids_(solids), distance_(distance), slack_(slack), stage_(stage) {}

    // Appends the corners and the midpoints that bisecting the longest edges adds until the triangles are
    // fine enough. Leaves off when there are too many in all, or when the stage must end.
    void sample(const Triangle3d& t, std::vector<Vec3d>& samples) {
        if (conceal(t)) return;
        samples.assign(t.begin(), t.end());
        refine(t, {distance_.at(t[0]), distance_.at(t[1]), distance_.at(t[2])}, samples);
    }

  private:
    void refine(const Triangle3d& t, const std::array<double, 3>& at, std::vector<Vec3d>& samples) {
        const int from = longest_edge(t);
        const int to = (from + 1) % 3;
        const int apex = (from + 2) % 3;
        const double limit = distance_.covering(std::min({at[0], at[1], at[2]})) - slack_;
        const double length2 = (t[to] - t[from]).squaredNorm();
        if (length2 < 4.0 * limit * limit && covering_radius(t) < limit) return;
        if (stage_.stopping() || too_many(samples.size())) return;
        // The sum commutes exactly, so both triangles of a shared edge get the same point.
        const Vec3d middle = 0.5 * (t[from] + t[to]);
        const double at_middle = distance_.at(middle);
        samples.push_back(middle);
        const Triangle3d first{t[from], middle, t[apex]};
        const Triangle3d second{middle, t[to], t[apex]};
        if (!conceal(first)) refine(first, {at[from], at_middle, at[apex]}, samples);
        if (!conceal(second)) refine(second, {at_middle, at[to], at[apex]}, samples);
    }

    // Gaps as narrow as rounding makes them count as closed.
    [[nodiscard]] bool conceal(const Triangle3d& t) const {
        return solids_.conceal(t, 0.001 * distance_.finest());
    }

    // Counts in blocks, so that the threads seldom meet.
    bool too_many(std::size_t of_one_triangle) {
        constexpr std::uint64_t block = 1024;
        if (of_one_triangle % block == 0) total_ += block;
        return total_ > max_samples;
    }

    const Solids& solids_;
    const SamplingDistance& distance_;
    const double slack_;
    const Stage& stage_;
    std::atomic<std::uint64_t> total_ = 0;
};

tl::unexpected<Error> too_many(const scene::Scene& scene, double distance, double at_least) {
    const auto millions = static_cast<std::uint64_t>(std::min(at_least / 1e6, 1e12));
    return fail(scene.source + ": a sampling distance of " + std::to_string(distance) +
                " map units needs more than " + std::to_string(millions) +
                " million samples, and the limit is " + std::to_string(max_samples / 1'000'000U) +
                " million; choose a larger d0");
}

}  // namespace

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

Result<std::vector<Vec3d>> sample(const scene::Scene& scene, const Solids& solids,
                                  const SamplingDistance& distance, double slack, Stage& stage) {
    std::vector<Triangle3d> triangles;
    triangles.reserve(scene.triangles.size());
    double discs = 0.0;  // a sample covers at most a disc
    for (const auto& [a, b, c] : scene.triangles) {
        triangles.push_back({scene.vertices[a], scene.vertices[b], scene.vertices[c]});
        discs += area(triangles.back()) / (M_PI * distance.coarsest() * distance.coarsest());
    }
    if (discs > static_cast<double>(max_samples)) return too_many(scene, distance.finest(), discs);

    Refinement refinement(solids, distance, slack, stage);
    std::vector<std::vector<Vec3d>> samples_of(triangles.size());
    const bool done = stage.for_each(
        triangles.size(), [&](std::uint64_t i) { refinement.sample(triangles[i], samples_of[i]); });
    if (!done) return stage.interrupted();
    std::size_t total = 0;
    for (const auto& of_one : samples_of)
        total += of_one.size();
    if (total > max_samples) return too_many(scene, distance.finest(), static_cast<double>(max_samples));
    std::vector<Vec3d> samples;
    samples.reserve(total);
    for (const auto& of_one : samples_of)
        samples.insert(samples.end(), of_one.begin(), of_one.end());
    stage.count("triangles", static_cast<double>(triangles.size()));
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
