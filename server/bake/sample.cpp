#include "bake/sample.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "bake/bisection.hpp"

namespace camdir::bake {
namespace {

// Refines obstacle triangles; one object for all threads.
class Refinement {
  public:
    Refinement(const Bisection& bisection, std::uint64_t limit, const Stage& stage)
        : bisection_(bisection), limit_(limit), stage_(stage) {}

    // Bisects longest edges until the triangles are fine enough, and collects the midpoints. Ends early when
    // there are too many in all, or when the stage must end. False when the triangle needs no samples.
    bool sample(const Triangle3d& t, std::vector<Vec3d>& midpoints) {
        if (bisection_.is_buried(t)) return false;
        if (total_ <= limit_) refine(bisection_.piece(t), midpoints);
        total_ += midpoints.size() % block;
        return true;
    }

  private:
    void refine(const Piece& piece, std::vector<Vec3d>& midpoints) {
        if (bisection_.is_fine(piece)) return;
        if (stage_.stopping() || too_many(midpoints.size())) return;
        const auto halves = bisection_.halves(piece);
        midpoints.push_back(halves[1].corners[0]);
        for (const Piece& half : halves)
            if (!bisection_.is_buried(half.corners)) refine(half, midpoints);
    }

    // Counts in blocks: the counter is shared by all threads.
    bool too_many(std::size_t of_one_triangle) {
        if (of_one_triangle > 0 && of_one_triangle % block == 0) total_ += block;
        return total_ > limit_;
    }

    static constexpr std::uint64_t block = 1024;

    const Bisection& bisection_;
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
    const Bisection bisection(solids, distance, slack);
    Refinement refinement(bisection, limit, stage);
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
