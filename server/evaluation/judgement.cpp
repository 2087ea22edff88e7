#include "evaluation/judgement.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/parallel.hpp"
#include "evaluation/picture.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::int64_t settling = 500'000'000;    // ns after an event in which nothing is counted
constexpr std::int64_t event_span = 100'000'000;  // ns after an event within which a cut belongs to it
constexpr double framed_share = 0.6;              // of the picture

// Of the player's box: its corners pulled in by 1 unit, and its centre.
std::array<Vec3d, body_point_count> body_points(const TracePose& pose, double unit) {
    const Box3d full_box = player_box(pose, unit);
    const Box3d box(full_box.min() + Vec3d::Constant(unit), full_box.max() - Vec3d::Constant(unit));
    std::array<Vec3d, body_point_count> points;
    for (int i = 0; i < 8; ++i)
        points[static_cast<std::size_t>(i)] = box.corner(static_cast<Box3d::CornerType>(i));
    points[8] = box.center();
    return points;
}

// Judges the cameras of one player in the trace's order.
class Judge {
  public:
    Judge(const oracle::Oracle& oracle, const oracle::Reachability& reachability,
          const Thresholds& thresholds)
        : oracle_(oracle), reachability_(reachability), limits_(thresholds) {}

    [[nodiscard]] Judgement add(std::int64_t time, const TracePose& pose, const CameraSample& camera) {
        if (pose.discontinuity) last_event_ = time;
        Judgement judgement;
        judgement.alive = pose.alive;
        judgement.counted = pose.alive && time - last_event_ > settling;
        judgement.cut = pose.alive && camera.cut;
        judgement.cut_at_event = judgement.cut && time - last_event_ <= event_span;
        const Sample now{time, &pose, &camera, judgement.counted};
        if (before_.pose != nullptr && before_.pose->alive && pose.alive) judge_step(now, judgement);
        if (now.counted) judge_frame(now, judgement);
        judge_motion(now, judgement);
        before_ = now;
        return judgement;
    }

    // The player has no pose in this frame.
    void skip() {
        meter_.end_segment();
        before_ = {};
    }

  private:
    struct Sample {
        std::int64_t time = 0;
        const TracePose* pose = nullptr;
        const CameraSample* camera = nullptr;
        bool counted = false;
    };

    void judge_frame(const Sample& now, Judgement& judgement) const {
        const TracePose& pose = *now.pose;
        const CameraSample& camera = *now.camera;
        const Vec3d to_eye = pose.eye - camera.position;
        const bool head = oracle_.segment_clear(camera.position, pose.eye);
        // What sees a living player's eye is joined to it by free space.
        judgement.in_solid =
            oracle_.in_solid(camera.position) || (!head && !reachability_.reachable(camera.position));
        judgement.distance = to_eye.norm();
        judgement.distance_error = std::abs(judgement.distance - limits_.distance);
        judgement.behind = degrees_between(to_eye, pose.orientation * Vec3d::UnitX());
        judgement.clearance = judgement.in_solid
                                  ? 0.0
                                  : std::min(oracle_.clearance(camera.position, limits_.largest_clearance),
                                             limits_.largest_clearance);
        judgement.too_close = judgement.distance < limits_.too_close;
        const auto fault = [&](bool present, Fault which) {
            if (present) judgement.faults |= which;
        };
        fault(!head, hidden);
        fault(!in_picture(camera, pose.eye, framed_share), out_of_frame);
        fault(judgement.clearance < limits_.clearance, low_clearance);
        fault(judgement.distance_error > limits_.distance_error, wrong_distance);
        fault(judgement.behind > limits_.behind, wrong_side);
        for (const Vec3d& point : body_points(pose, limits_.unit))
            judgement.body_points += oracle_.segment_clear(camera.position, point);
    }

    // A step between two frames of a living player.
    void judge_step(const Sample& now, Judgement& judgement) const {
        judgement.step_seconds = static_cast<double>(now.time - before_.time) * 1e-9;
        if (now.camera->cut) return;
        const double step = (now.camera->position - before_.camera->position).norm();
        const double eye_step = (now.pose->eye - before_.pose->eye).norm();
        judgement.speed = step / judgement.step_seconds;
        judgement.pop = step > std::max(limits_.pop, 3.0 * eye_step);
        judgement.judged_step = now.counted && before_.counted;
        judgement.fly_through =
            judgement.judged_step && !oracle_.segment_clear(before_.camera->position, now.camera->position);
    }

    void judge_motion(const Sample& now, Judgement& judgement) {
        if (!now.counted || now.camera->cut) meter_.end_segment();
        if (now.counted) judgement.motion = meter_.add(now.time, *now.camera);
    }

    const oracle::Oracle& oracle_;
    const oracle::Reachability& reachability_;
    const Thresholds& limits_;
    std::int64_t last_event_ = 0;
    Sample before_;
    MotionMeter meter_;
};

}  // namespace

Result<std::vector<Judgement>> judge(const oracle::Oracle& oracle, const oracle::Reachability& reachability,
                                     const Thresholds& thresholds, const Trace& trace,
                                     std::span<const CameraSample> cameras, const std::stop_token& stop) {
    assert(cameras.size() == trace.poses.size());
    std::vector<Judgement> judgements(cameras.size());
    parallel_for(std::size_t{0}, trace.players.size(), [&](std::size_t player) {
        Judge judge(oracle, reachability, thresholds);
        const auto track = track_of(trace, trace.players[player]);
        for (std::size_t frame = 0; frame < track.size() && !stop.stop_requested(); ++frame) {
            const std::uint32_t pose = track[frame];
            if (pose == absent)
                judge.skip();
            else
                judgements[pose] = judge.add(trace.frames[frame].time, trace.poses[pose], cameras[pose]);
        }
    });
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    return judgements;
}

}  // namespace camdir::evaluation
