#include <algorithm>
#include <atomic>
#include <limits>
#include <vector>

#include "evaluation/chunks.hpp"
#include "evaluation/verification_stages.hpp"
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
    Sampler(const VerificationJob& job, const oracle::ReachedGrid& grid)
        : job_(job), grid_(grid), box_(grid.joined_box()) {}

    // Of chunk_size points of the box those that are reachable.
    [[nodiscard]] std::vector<Sample> draw(std::uint64_t chunk) const {
        ChunkRandom random(job_.parameters.seed, purpose, chunk);
        std::vector<Sample> samples;
        // With a large d0 a point that joins nothing takes milliseconds.
        for (std::uint64_t i = 0; i < chunk_size && !job_.stop.stop_requested(); ++i) {
            const Vec3d part(random.uniform(), random.uniform(), random.uniform());
            const Vec3f point = (box_.min() + part.cwiseProduct(box_.sizes())).cast<float>();
            if (!grid_.joined(point.cast<double>())) continue;
            samples.push_back({job_.oracle.clearance(point.cast<double>()),
                               static_cast<double>(freespace::distance(job_.freespace, point).value)});
        }
        return samples;
    }

  private:
    const VerificationJob& job_;
    const oracle::ReachedGrid& grid_;
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

Result<void> verify_coverage(const VerificationJob& job, Verification& result) {
    const auto d0 = static_cast<double>(job.freespace.metadata().d0);
    const auto grid = oracle::ReachedGrid::explore(job.oracle, job.scene, oracle::grid_pitch(job.scene), d0,
                                                   explore_progress(job.progress), job.stop);
    if (!grid) return tl::unexpected(grid.error());
    if (grid->reached_count() == 0) return fail(job.scene.source + ": no spawn point lies in free space");

    const Sampler sampler(job, *grid);
    std::vector<Sample> samples;
    const std::uint64_t points = job.parameters.points;
    const std::uint64_t max_chunks = points * max_candidates_a_point / chunk_size + chunks_a_round;
    for (std::uint64_t chunk = 0; samples.size() < points && chunk < max_chunks; chunk += chunks_a_round) {
        std::atomic<std::uint64_t> found = samples.size();
        const auto draw = [&](std::uint64_t number) {
            auto some = sampler.draw(number);
            found += some.size();
            return some;
        };
        const auto tell = [&](std::uint64_t) {
            job.progress("coverage", std::min<std::uint64_t>(found, points), points);
        };
        const auto drawn = run_chunks<std::vector<Sample>>(chunk, chunks_a_round, job.stop, draw, tell);
        if (job.stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
        for (const std::vector<Sample>& some : drawn) {
            samples.insert(samples.end(), some.begin(), some.end());
        }
    }
    if (samples.size() > points) samples.resize(points);
    summarise(samples, d0, job.tolerance, result);
    return {};
}

}  // namespace camdir::evaluation
