#include "evaluation/verify_coverage.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "evaluation/chunks.hpp"
#include "freespace/distance.hpp"
#include "oracle/reached_grid.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::uint32_t purpose = 5;  // verify_balls has 1 to 4
constexpr std::uint64_t chunks_a_round = 64;
// Gives up on a reachable volume that is this small a part of its box.
constexpr std::uint64_t max_candidates_a_point = 10'000;

struct Sample {
    double clearance;
    double reported;
};

class Sampler {
  public:
    Sampler(const freespace::Freespace& freespace, const scene::Scene& scene, const oracle::Oracle& oracle,
            std::uint64_t seed)
        : freespace_(freespace),
          oracle_(oracle),
          seed_(seed),
          grid_(oracle, scene.bounds, oracle::spawn_eyes(scene), oracle::grid_pitch(scene),
                static_cast<double>(freespace.metadata().d0)),
          box_(grid_.joined_box()) {}

    [[nodiscard]] bool is_empty() const { return grid_.reached_count() == 0; }

    // Of chunk_size points of the box those that are reachable.
    [[nodiscard]] std::vector<Sample> draw(std::uint64_t chunk) const {
        ChunkRandom random(seed_, purpose, chunk);
        std::vector<Sample> samples;
        for (std::uint64_t i = 0; i < chunk_size; ++i) {
            const Vec3d part(random.uniform(), random.uniform(), random.uniform());
            const Vec3f point = (box_.min() + part.cwiseProduct(box_.sizes())).cast<float>();
            if (!grid_.joined(point.cast<double>())) continue;
            samples.push_back({oracle_.clearance(point.cast<double>()),
                               static_cast<double>(freespace::distance_everywhere(freespace_, point).value)});
        }
        return samples;
    }

  private:
    const freespace::Freespace& freespace_;
    const oracle::Oracle& oracle_;
    std::uint64_t seed_;
    oracle::ReachedGrid grid_;
    Box3d box_;
};

void summarise(const std::vector<Sample>& samples, double d0, double tolerance, Verification& result) {
    const std::array<double, 3> thresholds = {0.0, d0, 2.0 * d0};
    double sum_of_ratios = 0.0;
    for (const auto& [clearance, reported] : samples) {
        for (std::size_t bucket = 0; bucket < thresholds.size(); ++bucket) {
            if (!(clearance > thresholds[bucket])) continue;
            ++result.coverage[bucket].points;
            if (reported > 0.0) ++result.coverage[bucket].covered;
        }
        if (clearance > d0) sum_of_ratios += std::max(reported, 0.0) / clearance;
        if (reported > 0.0 && reported > clearance + tolerance) {
            ++result.overestimates;
            result.largest_overestimate = std::max(result.largest_overestimate, reported - clearance);
        }
    }
    result.tightness = result.coverage[1].points > 0
                           ? sum_of_ratios / static_cast<double>(result.coverage[1].points)
                           : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

Result<void> verify_coverage(const freespace::Freespace& freespace, const scene::Scene& scene,
                             const oracle::Oracle& oracle, double tolerance,
                             const VerificationParameters& parameters, const VerificationProgress& progress,
                             const std::stop_token& stop, Verification& result) {
    progress("exploring", 0, 0);
    const Sampler sampler(freespace, scene, oracle, parameters.seed);
    if (sampler.is_empty()) return fail("no spawn point of the map lies in free space");

    std::vector<Sample> samples;
    const std::uint64_t max_chunks = parameters.points * max_candidates_a_point / chunk_size + chunks_a_round;
    for (std::uint64_t chunk = 0; samples.size() < parameters.points && chunk < max_chunks;
         chunk += chunks_a_round) {
        const auto drawn = run_chunks<std::vector<Sample>>(
            chunk, chunks_a_round, stop, [&](std::uint64_t i) { return sampler.draw(i); },
            [&](std::uint64_t) { progress("coverage", samples.size(), parameters.points); });
        if (stop.stop_requested()) return {};
        for (const std::vector<Sample>& some : drawn) {
            samples.insert(samples.end(), some.begin(), some.end());
        }
    }
    if (samples.size() > parameters.points) samples.resize(parameters.points);
    summarise(samples, static_cast<double>(freespace.metadata().d0), tolerance, result);
    return {};
}

}  // namespace camdir::evaluation
