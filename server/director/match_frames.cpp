// Match: from pose frames to camera frames.
#include <spdlog/spdlog.h>

#include <chrono>

#include "director/clock.hpp"
#include "director/match.hpp"

namespace camdir::director {
namespace {

using Clock = std::chrono::steady_clock;

std::int64_t ns(Clock::duration duration) {
    return duration / std::chrono::nanoseconds(1);
}

camera::Pose tracker_pose(const PlayerPose& pose, bool gap) {
    return {pose.eye, pose.orientation, pose.velocity, (pose.flags & pose_alive) != 0,
            gap || (pose.flags & pose_discontinuity) != 0};
}

std::span<const PlayerPose> tracked(const PoseFrame& frame, const config::Limits& limits) {
    return std::span(frame.poses)
        .first(std::min(frame.poses.size(), static_cast<std::size_t>(limits.players)));
}

}  // namespace

void Match::process(const PoseFrame& frame, std::int64_t received_ns) {
    if (!accept(frame)) return;
    const double dt = has_last_frame_ ? seconds_between(last_time_, frame.frame_time) : 0.0;
    record(frame);
    if (reconcile_needed_) reconcile();
    if (!freespace_) return counters_.add(Counter::drop_waiting);
    if (!requests_.shots().empty()) {
        move_cameras(frame, dt);
        publisher_.publish(match_id_, cameras_);
        counters_.latency.add(ns(Clock::now().time_since_epoch()) - received_ns);
    }
    after_silence_ = false;
}

bool Match::accept(const PoseFrame& frame) {
    const auto dropped = [&](Counter reason) {
        counters_.add(reason);
        return false;
    };
    if (!info_) return dropped(Counter::drop_unknown_match);
    if (frame.epoch < info_->epoch) return dropped(Counter::drop_old_epoch);
    if (frame.epoch > info_->epoch) return dropped(Counter::drop_early_epoch);
    // Signed difference: frame numbers may wrap.
    if (has_last_frame_ && static_cast<std::int32_t>(frame.frame_number - last_number_) <= 0)
        return dropped(Counter::drop_old_frame);
    return true;
}

void Match::record(const PoseFrame& frame) {
    counters_.add(Counter::pose_frames);
    if (liveness_ != Liveness::running) {
        spdlog::info("match {}: poses arrive again", match_id_);
        liveness_ = Liveness::running;
        reconcile_needed_ = true;
    }
    has_last_frame_ = true;
    last_pose_ns_ = now_ns();
    last_number_ = frame.frame_number;
    last_time_ = frame.frame_time;
    const auto poses = tracked(frame, config_->limits);
    const std::uint64_t skipped = roster_.update(poses, config_->matches.silence_frames);
    counters_.add(Counter::drop_players, skipped + (frame.poses.size() - poses.size()));
    if (roster_.take_changed()) reconcile_needed_ = true;
}

void Match::move_cameras(const PoseFrame& frame, double dt) {
    cameras_.epoch = frame.epoch;
    cameras_.frame_number = next_camera_frame_++;
    cameras_.pose_number = frame.frame_number;
    cameras_.frame_time = frame.frame_time;
    cameras_.source_time = frame.source_time;
    cameras_.cameras.clear();
    auto before = Clock::now();
    for (Shot& shot : requests_.shots()) {
        cameras_.cameras.push_back(move_camera(shot, frame, dt));
        const auto after = Clock::now();
        counters_.step.add(ns(after - before));
        before = after;
    }
    counters_.add(Counter::camera_frames);
    counters_.add(Counter::cameras, cameras_.cameras.size());
}

ShotCamera Match::move_camera(Shot& shot, const PoseFrame& frame, double dt) {
    std::uint32_t target = shot.key.target;
    if (target == no_player) {
        attention_.choose(shot.automatic, shot.key.group, tracked(frame, config_->limits), roster_,
                          config_->matches, frame.frame_time);
        target = shot.automatic.player;
    }
    if (target != shot.target) shot.state = {};  // a fresh state starts with a cut
    shot.target = target;

    const PlayerPose* seen = roster_.pose(target);
    const camera::Pose pose = seen != nullptr ? tracker_pose(*seen, after_silence_) : camera::Pose{};
    const camera::Camera camera =
        camera::step(*freespace_, shot.profile, seen != nullptr ? &pose : nullptr, dt, shot.state, *scratch_);

    if ((camera.flags & camera::cut) != 0) counters_.add(Counter::cuts);
    if ((camera.flags & camera::searching) != 0 && (shot.flags & camera::searching) == 0)
        counters_.add(Counter::searches);
    shot.flags = camera.flags;
    return {shot.camera_id,      target,           camera.position, camera.orientation,
            camera.vertical_fov, camera.clearance, camera.flags};
}

}  // namespace camdir::director
