#include "evaluation/metrics.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include "base/parallel.hpp"
#include "evaluation/motion.hpp"
#include "evaluation/picture.hpp"
#include "evaluation/statistics.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::int64_t settling = 500'000'000;    // ns after an event in which nothing is counted
constexpr std::int64_t event_span = 100'000'000;  // ns after an event within which a cut belongs to it
constexpr double framed_share = 0.6;              // of the picture

// The thresholds in map units.
struct Thresholds {
    explicit Thresholds(double metres_per_unit) : unit(scene::metres_of_nominal_unit / metres_per_unit) {}

    double unit;
    double distance = 120.0 * unit;  // d_opt
    double clearance = 4.0 * unit;
    double pop = 64.0 * unit;
    double behind = 60.0;  // degrees
};

// Of the player's box: its corners pulled in by 1 unit, and its centre.
std::array<Vec3d, 9> body_points(const TracePose& pose, double unit) {
    const Box3d full_box = player_box(pose, unit);
    const Box3d box(full_box.min() + Vec3d::Constant(unit), full_box.max() - Vec3d::Constant(unit));
    std::array<Vec3d, 9> points;
    for (int i = 0; i < 8; ++i)
        points[static_cast<std::size_t>(i)] = box.corner(static_cast<Box3d::CornerType>(i));
    points[8] = box.center();
    return points;
}

// What one player's cameras, or all players' together, gave.
struct Tally {
    std::size_t frames = 0;  // counted
    std::size_t good = 0;
    std::size_t head = 0;
    std::size_t body_points = 0;
    std::size_t low_clearance = 0;
    std::size_t solid = 0;
    std::size_t too_close = 0;
    std::size_t in_frame = 0;
    std::size_t steps = 0;
    std::size_t fly_through = 0;
    std::vector<double> distance_error;
    std::vector<double> behind;
    MotionSamples motion;
    double alive_minutes = 0.0;
    std::size_t pops = 0;
    std::size_t cuts = 0;
    std::size_t cuts_at_events = 0;
    double largest_speed = 0.0;

    void add(const Tally& other);
};

void append(std::vector<double>& all, const std::vector<double>& more) {
    all.insert(all.end(), more.begin(), more.end());
}

void Tally::add(const Tally& other) {
    frames += other.frames;
    good += other.good;
    head += other.head;
    body_points += other.body_points;
    low_clearance += other.low_clearance;
    solid += other.solid;
    too_close += other.too_close;
    in_frame += other.in_frame;
    steps += other.steps;
    fly_through += other.fly_through;
    append(distance_error, other.distance_error);
    append(behind, other.behind);
    append(motion.acceleration, other.motion.acceleration);
    append(motion.jerk, other.motion.jerk);
    append(motion.angular_speed, other.motion.angular_speed);
    append(motion.angular_acceleration, other.motion.angular_acceleration);
    motion.comfortable += other.motion.comfortable;
    motion.largest_rotation = std::max(motion.largest_rotation, other.motion.largest_rotation);
    alive_minutes += other.alive_minutes;
    pops += other.pops;
    cuts += other.cuts;
    cuts_at_events += other.cuts_at_events;
    largest_speed = std::max(largest_speed, other.largest_speed);
}

// Judges the cameras of one player in the trace's order.
class Judge {
  public:
    Judge(const oracle::Oracle& oracle, const oracle::Reachability& reachability,
          const Thresholds& thresholds)
        : oracle_(oracle), reachability_(reachability), limits_(thresholds) {}
    Judge(const Judge&) = delete;
    Judge& operator=(const Judge&) = delete;

    void add(std::int64_t time, const TracePose& pose, const CameraSample& camera) {
        if (pose.discontinuity) last_event_ = time;
        const Sample now{time, &pose, &camera, pose.alive && time - last_event_ > settling};
        if (before_.pose != nullptr && before_.pose->alive && pose.alive) judge_step(now);
        if (pose.alive && camera.cut)
            ++(time - last_event_ <= event_span ? tally_.cuts_at_events : tally_.cuts);
        if (now.counted) judge_frame(pose, camera);
        judge_motion(now);
        before_ = now;
    }

    // The player has no pose in this frame.
    void skip() {
        meter_.end_segment();
        before_ = {};
    }

    [[nodiscard]] const Tally& tally() const { return tally_; }

  private:
    struct Sample {
        std::int64_t time = 0;
        const TracePose* pose = nullptr;
        const CameraSample* camera = nullptr;
        bool counted = false;
    };

    void judge_frame(const TracePose& pose, const CameraSample& camera) {
        const Vec3d to_eye = pose.eye - camera.position;
        const double distance = to_eye.norm();
        const double error = std::abs(distance - limits_.distance);
        const double behind = degrees_between(to_eye, pose.orientation * Vec3d::UnitX());
        const bool head = oracle_.segment_clear(camera.position, pose.eye);
        const bool framed = in_picture(camera, pose.eye, framed_share);
        // What sees a living player's eye is joined to it by free space.
        const bool solid =
            oracle_.in_solid(camera.position) || (!head && !reachability_.reachable(camera.position));
        const bool low = solid || oracle_.clearance(camera.position, limits_.clearance) < limits_.clearance;
        ++tally_.frames;
        tally_.head += head;
        tally_.in_frame += framed;
        tally_.solid += solid;
        tally_.low_clearance += low;
        tally_.too_close += distance < limits_.distance / 3.0;
        tally_.good += head && framed && !low && error <= limits_.distance / 2.0 && behind <= limits_.behind;
        tally_.distance_error.push_back(error);
        tally_.behind.push_back(behind);
        for (const Vec3d& point : body_points(pose, limits_.unit))
            tally_.body_points += oracle_.segment_clear(camera.position, point);
    }

    // A step between two frames of a living player.
    void judge_step(const Sample& now) {
        const double seconds = static_cast<double>(now.time - before_.time) * 1e-9;
        tally_.alive_minutes += seconds / 60.0;
        if (now.camera->cut) return;
        const double step = (now.camera->position - before_.camera->position).norm();
        const double eye_step = (now.pose->eye - before_.pose->eye).norm();
        tally_.pops += step > std::max(limits_.pop, 3.0 * eye_step);
        tally_.largest_speed = std::max(tally_.largest_speed, step / seconds);
        if (!now.counted || !before_.counted) return;
        ++tally_.steps;
        tally_.fly_through += !oracle_.segment_clear(before_.camera->position, now.camera->position);
    }

    void judge_motion(const Sample& now) {
        if (!now.counted || now.camera->cut) meter_.end_segment();
        if (now.counted) meter_.add(now.time, *now.camera);
    }

    const oracle::Oracle& oracle_;
    const oracle::Reachability& reachability_;
    const Thresholds& limits_;
    std::int64_t last_event_ = 0;
    Sample before_;
    Tally tally_;
    MotionMeter meter_{tally_.motion};
};

double per_cent(std::size_t part, std::size_t total) {
    return total == 0 ? unmeasured : 100.0 * static_cast<double>(part) / static_cast<double>(total);
}

Spread spread(const std::vector<double>& values) {
    return {root_mean_square(values), percentile(values, 0.95), percentile(values, 0.99)};
}

Metrics summarise(const Tally& tally) {
    Metrics metrics;
    metrics.good = per_cent(tally.good, tally.frames);
    metrics.visible_head = per_cent(tally.head, tally.frames);
    metrics.visible_body = per_cent(tally.body_points, 9 * tally.frames);
    metrics.clearance_lt4 = per_cent(tally.low_clearance, tally.frames);
    metrics.in_solid = per_cent(tally.solid, tally.frames);
    metrics.fly_through = per_cent(tally.fly_through, tally.steps);
    metrics.dist_err = mean(tally.distance_error);
    metrics.dist_err_p95 = percentile(tally.distance_error, 0.95);
    metrics.too_close = per_cent(tally.too_close, tally.frames);
    metrics.behind = mean(tally.behind);
    metrics.behind_p95 = percentile(tally.behind, 0.95);
    metrics.in_frame = per_cent(tally.in_frame, tally.frames);
    metrics.acc = spread(tally.motion.acceleration);
    metrics.jerk = spread(tally.motion.jerk);
    metrics.ang_speed = spread(tally.motion.angular_speed);
    metrics.ang_acc = spread(tally.motion.angular_acceleration);
    metrics.comfort = per_cent(tally.motion.comfortable, tally.motion.angular_speed.size());
    metrics.max_rotation = tally.motion.largest_rotation;
    const auto per_minute = [&](std::size_t count) {
        return tally.alive_minutes > 0.0 ? static_cast<double>(count) / tally.alive_minutes : unmeasured;
    };
    metrics.pops = per_minute(tally.pops);
    metrics.max_speed = tally.largest_speed;
    metrics.cuts = per_minute(tally.cuts);
    metrics.cuts_at_events = per_minute(tally.cuts_at_events);
    return metrics;
}

void judge_player(std::uint32_t player, const Trace& trace, std::span<const CameraSample> cameras,
                  const std::stop_token& stop, Judge& judge) {
    const auto track = track_of(trace, player);
    for (std::size_t frame = 0; frame < track.size() && !stop.stop_requested(); ++frame) {
        if (track[frame] == absent)
            judge.skip();
        else
            judge.add(trace.frames[frame].time, trace.poses[track[frame]], cameras[track[frame]]);
    }
}

}  // namespace

Result<Metrics> measure(const scene::Scene& scene, const oracle::Oracle& oracle, const Trace& trace,
                        std::span<const CameraSample> cameras, const oracle::ExploreProgress& progress,
                        const std::stop_token& stop) {
    assert(cameras.size() == trace.poses.size());
    const auto reachability = oracle::Reachability::explore(oracle, scene, progress, stop);
    if (!reachability) return tl::unexpected(reachability.error());
    const Thresholds thresholds(scene.metres_per_unit);
    std::vector<Tally> tallies(trace.players.size());
    parallel_for(std::size_t{0}, tallies.size(), [&](std::size_t i) {
        Judge judge(oracle, *reachability, thresholds);
        judge_player(trace.players[i], trace, cameras, stop, judge);
        tallies[i] = judge.tally();
    });
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    Tally all;
    for (const Tally& tally : tallies)
        all.add(tally);
    return summarise(all);
}

}  // namespace camdir::evaluation
