#include "evaluation/metrics.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/statistics.hpp"

namespace camdir::evaluation {
namespace {

double per_cent(std::size_t part, std::size_t total) {
    return total == 0 ? unmeasured : 100.0 * static_cast<double>(part) / static_cast<double>(total);
}

Spread spread(const std::vector<double>& values) {
    return {root_mean_square(values), percentile(values, 0.95), percentile(values, 0.99)};
}

// Counts and collects what the judgements say.
class Summary {
  public:
    explicit Summary(std::span<const Judgement> judgements) : judgements_(judgements) {}

    [[nodiscard]] std::size_t count(bool Judgement::*flag) const {
        return count_if([flag](const Judgement& j) { return j.*flag; });
    }

    [[nodiscard]] std::size_t without(Fault fault) const {
        return count_if([fault](const Judgement& j) { return j.counted && (j.faults & fault) == 0; });
    }

    template <class Predicate>
    [[nodiscard]] std::size_t count_if(const Predicate& predicate) const {
        return static_cast<std::size_t>(std::ranges::count_if(judgements_, predicate));
    }

    // What was measured of it.
    [[nodiscard]] std::vector<double> values(double Judgement::*value) const {
        return measured(judgements_, [value](const Judgement& j) { return j.*value; });
    }
    [[nodiscard]] std::vector<double> values(double Motion::*value) const {
        return measured(judgements_, [value](const Judgement& j) { return j.motion.*value; });
    }

    [[nodiscard]] std::size_t body_points() const {
        std::size_t sum = 0;
        for (const Judgement& judgement : judgements_)
            sum += judgement.body_points;
        return sum;
    }

  private:
    std::span<const Judgement> judgements_;
};

double largest(const std::vector<double>& values) {
    return values.empty() ? 0.0 : std::ranges::max(values);
}

void summarise_frames(const Summary& summary, Metrics& metrics) {
    const std::size_t frames = summary.count(&Judgement::counted);
    const auto good = summary.count_if([](const Judgement& j) { return j.counted && j.faults == 0; });
    metrics.good = per_cent(good, frames);
    metrics.visible_head = per_cent(summary.without(hidden), frames);
    metrics.visible_body = per_cent(summary.body_points(), body_point_count * frames);
    metrics.clearance_lt4 = per_cent(frames - summary.without(low_clearance), frames);
    metrics.in_solid = per_cent(summary.count(&Judgement::in_solid), frames);
    metrics.fly_through =
        per_cent(summary.count(&Judgement::fly_through), summary.count(&Judgement::judged_step));
    const auto errors = summary.values(&Judgement::distance_error);
    metrics.dist_err = mean(errors);
    metrics.dist_err_p95 = percentile(errors, 0.95);
    metrics.too_close = per_cent(summary.count(&Judgement::too_close), frames);
    const auto behind = summary.values(&Judgement::behind);
    metrics.behind = mean(behind);
    metrics.behind_p95 = percentile(behind, 0.95);
    metrics.in_frame = per_cent(summary.without(out_of_frame), frames);
}

void summarise_motion(const Summary& summary, Metrics& metrics) {
    metrics.acc = spread(summary.values(&Motion::acceleration));
    metrics.jerk = spread(summary.values(&Motion::jerk));
    const auto angular_speeds = summary.values(&Motion::angular_speed);
    metrics.ang_speed = spread(angular_speeds);
    metrics.ang_acc = spread(summary.values(&Motion::angular_acceleration));
    const auto comfortable = summary.count_if([](const Judgement& j) { return j.motion.comfortable; });
    metrics.comfort = per_cent(comfortable, angular_speeds.size());
    metrics.max_rotation = largest(summary.values(&Motion::rotation));
}

void summarise_shot(const Summary& summary, Metrics& metrics) {
    double seconds = 0.0;
    for (const double step : summary.values(&Judgement::step_seconds))
        seconds += step;
    const auto per_minute = [&](std::size_t count) {
        return seconds > 0.0 ? static_cast<double>(count) / (seconds / 60.0) : unmeasured;
    };
    const std::size_t cuts_at_events = summary.count(&Judgement::cut_at_event);
    metrics.pops = per_minute(summary.count(&Judgement::pop));
    metrics.max_speed = largest(summary.values(&Judgement::speed));
    metrics.cuts = per_minute(summary.count(&Judgement::cut) - cuts_at_events);
    metrics.cuts_at_events = per_minute(cuts_at_events);
}

}  // namespace

Metrics summarise(std::span<const Judgement> judgements) {
    const Summary summary(judgements);
    Metrics metrics;
    summarise_frames(summary, metrics);
    summarise_motion(summary, metrics);
    summarise_shot(summary, metrics);
    return metrics;
}

Result<Metrics> measure(const scene::Scene& scene, const oracle::Oracle& oracle, const Trace& trace,
                        std::span<const CameraSample> cameras, const oracle::ExploreProgress& progress,
                        const std::stop_token& stop) {
    const auto reachability = oracle::Reachability::explore(oracle, scene, progress, stop);
    if (!reachability) return tl::unexpected(reachability.error());
    const auto judgements =
        judge(oracle, *reachability, Thresholds(scene.metres_per_unit), trace, cameras, stop);
    if (!judgements) return tl::unexpected(judgements.error());
    return summarise(*judgements);
}

}  // namespace camdir::evaluation
