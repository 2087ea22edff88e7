// Match: from pose frames to camera frames.
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <utility>

#include "director/clock.hpp"
#include "director/match.hpp"

namespace camdir::director {
namespace {

constexpr double max_ahead_s = 2.5;       // that the planner uses
constexpr double arrival_jitter_s = 0.1;  // of poses
constexpr double lead_s = 1e-9 * static_cast<double>(DelayBuffer::lead_ns);
constexpr double first_step_s = 1.0 / 60.0;
constexpr double rounding_s = 1e-6;  // trackers may count the same time by another sum
// So many are worth waking another worker for.
constexpr std::size_t shots_per_worker = 8;
constexpr std::size_t beginning_group_shots_per_worker = 1;  // whose first step takes milliseconds

// Counts how long it lives.
class Timed {
  public:
    explicit Timed(DurationCounter& counter) : counter_(counter) {}
    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;
    ~Timed() { counter_.add(now_ns() - begun_); }

  private:
    DurationCounter& counter_;
    std::int64_t begun_ = now_ns();
};

bool was_moved(const PlayerPose& pose) {
    return (pose.flags & pose_discontinuity) != 0;
}

std::span<const PlayerPose> tracked(const PoseFrame& frame, const config::Limits& limits) {
    return std::span(frame.poses)
        .first(std::min(frame.poses.size(), static_cast<std::size_t>(limits.players)));
}

bool is_beginning_group(const Shot& shot) {
    return shot.is_of_group() && !shot.group.started && !shot.is_prepared;
}

CameraFrame no_cameras(const PoseFrame& frame) {
    return {frame.epoch, 0, frame.frame_number, frame.frame_time, frame.source_time, {}, {}};
}

}  // namespace

void Match::process(PoseFrame& frame, std::int64_t received_ns, Turn& turn) {
    const std::int64_t begun_ns = now_ns();
    if (!accept(frame)) return;
    mark_discontinuities(frame);
    const double dt = has_last_frame_ ? seconds_between(last_time_, frame.frame_time) : 0.0;
    causal_time_ += camera::usable_frame(dt);
    record(frame);
    if (reconcile_needed_ || waits_for_delay_) reconcile();
    if (foresee(frame) != by_timeline_) {
        by_timeline_ = !by_timeline_;
        requests_.restart_shots();
        obstacles_.clear();
    }
    place_obstacles(frame);
    if (map_.freespace() == nullptr) {
        counters_.add(Counter::drop_waiting);
        return show(frame, no_cameras(frame));
    }
    if (frames_per_camera_ != wanted_frames_per_camera()) publish_info();
    if (requests_.shots().empty()) {
        show(frame, no_cameras(frame));
    } else {
        CameraFrame& cameras = follower_.next_own();
        move_cameras(frame, dt, cameras, turn);
        const std::int64_t computed_ns = now_ns();
        publisher_.publish(match_id_, cameras);
        const std::int64_t written_ns = now_ns();
        counters_.waiting.add(begun_ns - received_ns);
        counters_.computing.add(computed_ns - begun_ns);
        counters_.writing.add(written_ns - computed_ns);
        counters_.latency.add(written_ns - received_ns);
        show(frame, cameras);
        edit_.look(edit_setting());
    }
    after_silence_ = false;
}

void Match::show(const PoseFrame& frame, const CameraFrame& cameras) {
    for (Audience* audience : audiences_)
        audience->show(match_id_, frame, cameras);
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

// Also where the frame that declared them has not been processed.
void Match::mark_discontinuities(PoseFrame& frame) {
    for (PlayerPose& pose : frame.poses)
        if (continuity_.broken(pose)) pose.flags |= pose_discontinuity;
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

// Enters into the timeline what the delay lets be known at this frame; false when it holds nothing. What has
// surely arrived when the frame is prepared is all that counts: the same poses give the same cameras, however
// punctual.
bool Match::extend_timeline(std::uint64_t epoch, std::int64_t frame_time) {
    const double ahead = std::clamp(delay_.state().delay_s - arrival_jitter_s - lead_s, 0.0, max_ahead_s);
    const auto add = [&](const PoseFrame& later) {
        if (later.epoch != epoch) return later.epoch < epoch;
        // A timeline begins with this frame or an earlier one.
        const double reach = timeline_.empty() ? 0.0 : ahead;
        if (seconds_between(frame_time, later.frame_time) > reach) return false;
        return timeline_.add(later, tracked(later, config_->limits));
    };
    return delay_.look_ahead(foreseen_, add);
}

bool Match::foresee(const PoseFrame& frame) {
    if (!extend_timeline(frame.epoch, frame.frame_time)) return false;
    if (!timeline_.covers(frame.frame_time)) {  // the game's clock has jumped
        if (!timeline_.empty()) requests_.restart_shots();
        timeline_.clear();
        obstacles_.clear();
        extend_timeline(frame.epoch, frame.frame_time);
    }
    if (!timeline_.covers(frame.frame_time)) return false;
    timeline_.show(frame.frame_time);
    return true;
}

void Match::place_obstacles(const PoseFrame& frame) {
    const bool changed =
        by_timeline_ ? obstacles_.follow(timeline_) : obstacles_.add(causal_time_, frame.movers);
    if (frame.movers != shown_movers_) counters_.add(Counter::mover_frames);
    shown_movers_ = frame.movers;
    if (changed) map_.report_unknown_movers(obstacles_.unknown());
}

void Match::gather_crowd(const PoseFrame& frame) {
    if (by_timeline_) return gather_crowd(timeline_.shown());
    crowd_.clear();
    crowd_poses_.clear();
    for (const PlayerPose& pose : tracked(frame, config_->limits))
        crowd_poses_.push_back({causal_time_ - rounding_s, camera_pose(pose, was_moved(pose)),
                                (pose.flags & pose_spectator) == 0});
    for (std::size_t i = 0; i < crowd_poses_.size(); ++i)
        crowd_.push_back({frame.poses[i].player_id, {&crowd_poses_[i], 1}});
}

void Match::gather_crowd(double time) {
    crowd_.clear();
    timeline_.add_to(crowd_, time);
}

void Match::move_cameras(const PoseFrame& frame, double dt, CameraFrame& cameras, Turn& turn) {
    cameras.epoch = frame.epoch;
    cameras.frame_number = next_camera_frame_++;
    cameras.pose_number = frame.frame_number;
    cameras.frame_time = frame.frame_time;
    cameras.source_time = frame.source_time;

    choose_targets(frame, cameras);
    gather_crowd(frame);
    std::vector<Shot>& shots = requests_.shots();
    cameras.cameras.resize(shots.size());
    const bool begins = std::ranges::any_of(shots, is_beginning_group);
    share_shots(turn, shots.size(), begins, [&](std::size_t i, camera::Scratch& scratch) {
        cameras.cameras[i] = move_camera(shots[i], dt, scratch);
    });
    counters_.add(Counter::camera_frames);
    counters_.add(Counter::cameras, cameras.cameras.size());
}

void Match::share_shots(Turn& turn, std::size_t count, bool begins_group_shot,
                        const std::function<void(std::size_t, camera::Scratch&)>& move) {
    scratch_.resize(turn.lanes());
    const std::size_t share = begins_group_shot ? beginning_group_shots_per_worker : shots_per_worker;
    turn.share(count, share, [&](std::size_t lane, std::size_t i) {
        if (!scratch_[lane]) scratch_[lane] = std::make_unique<camera::Scratch>(*map_.freespace());
        move(i, *scratch_[lane]);
    });
}

bool Match::prepare(Turn& turn) {
    if (!by_timeline_ || map_.freespace() == nullptr) return false;
    if (pace_.frames_per_camera() > 1) return false;  // it may not be due
    const auto next = delay_.upcoming();
    if (!next || next->epoch != info_->epoch || next->after != last_time_) return false;
    if (content_.has_frame) {
        turn.again();  // frames of other matches that are due go first
        return false;
    }
    extend_timeline(next->epoch, next->frame_time);
    const double time = timeline_.seconds(next->frame_time);
    if (!timeline_.covers(next->frame_time) || time <= timeline_.shown()) return false;
    if (obstacles_.follow(timeline_)) map_.report_unknown_movers(obstacles_.unknown());
    gather_crowd(time);
    unprepared_.clear();
    for (Shot& shot : requests_.shots())
        if (shot.target != no_player && !(shot.is_prepared && shot.prepared->time == time))
            unprepared_.push_back(&shot);
    // In more turns than one where a worker would be busy for long: what is due waits for it.
    const std::size_t count = std::min(unprepared_.size(), shots_per_worker * turn.workers());
    const bool begins =
        std::ranges::any_of(unprepared_, [](const Shot* shot) { return is_beginning_group(*shot); });
    share_shots(turn, count, begins, [&](std::size_t i, camera::Scratch& scratch) {
        prepare_step(*unprepared_[i], time, scratch);
    });
    if (count < unprepared_.size()) turn.again();
    return true;
}

void Match::prepare_step(Shot& shot, double time, camera::Scratch& scratch) {
    if (!shot.prepared) shot.prepared = std::make_unique<PreparedStep>();
    PreparedStep& step = *shot.prepared;
    step.time = time;
    step.state = shot.state;
    step.group = shot.group;
    step.camera =
        shot.is_of_group() ? step_group_to(time, shot, step.group) : step_to(time, shot, step.state, scratch);
    shot.is_prepared = true;
}

ShotCamera Match::move_camera(Shot& shot, double dt, camera::Scratch& scratch) {
    if (shot.fixed != freespace::none) return show_fixed(shot);
    const PlayerPose* seen = roster_.pose(shot.target);
    const camera::Camera camera = by_timeline_         ? step_by_timeline(shot, seen, scratch)
                                  : shot.is_of_group() ? step_group_by_poses(shot, dt)
                                                       : step_by_pose(shot, seen, dt, scratch);

    if ((camera.flags & camera::cut) != 0) counters_.add(Counter::cuts);
    if (!shot.is_of_group() && (camera.flags & camera::searching) != 0 &&
        (shot.flags & camera::searching) == 0)
        counters_.add(Counter::searches);
    shot.flags = camera.flags;
    shot.position = camera.position;
    return {shot.camera_id,      shot.target,      camera.position, camera.orientation,
            camera.vertical_fov, camera.clearance, camera.flags};
}

ShotCamera Match::show_fixed(Shot& shot) {
    ShotCamera camera = still_camera(shot.camera_id, map_.freespace()->fixed_shots()[shot.fixed]);
    camera.clearance = freespace::distance(space_shown(), camera.position).value;
    if (!std::exchange(shot.state.started, true)) {
        camera.flags = camera::cut;
        counters_.add(Counter::cuts);
    }
    shot.flags = camera.flags;
    shot.position = camera.position;
    return camera;
}

camera::Camera Match::step_by_pose(Shot& shot, const PlayerPose* seen, double dt, camera::Scratch& scratch) {
    const Timed timed(counters_.step);
    if (!shot.state.started) shot.state.time = causal_time_ - camera::usable_frame(dt);
    camera::Pose pose;
    if (seen != nullptr) pose = camera_pose(*seen, after_silence_ || was_moved(*seen));
    return camera::step(space(), shot.profile, seen != nullptr ? &pose : nullptr, dt, shot.state, scratch,
                        {crowd_, shot.target});
}

camera::Camera Match::step_by_timeline(Shot& shot, const PlayerPose* seen, camera::Scratch& scratch) {
    if (after_silence_ && (shot.is_of_group() || seen != nullptr)) shot.restart();
    const bool prepared = std::exchange(shot.is_prepared, false) && shot.prepared->time == timeline_.shown();
    if (!prepared)
        return shot.is_of_group() ? step_group_to(timeline_.shown(), shot, shot.group)
                                  : step_to(timeline_.shown(), shot, shot.state, scratch);
    shot.state = shot.prepared->state;
    shot.group = shot.prepared->group;
    return shot.prepared->camera;
}

camera::Camera Match::step_group_by_poses(Shot& shot, double dt) {
    const Timed timed(counters_.step);
    if (after_silence_) shot.restart();
    if (!shot.group.started) shot.group.time = causal_time_ - camera::usable_frame(dt);
    std::array<camera::TimedPose, camera::max_members> poses;
    std::array<camera::Window, camera::max_members> windows;
    const std::size_t count = shot.key.group.size();
    for (std::size_t i = 0; i < count; ++i) {
        const PlayerPose* seen = roster_.pose(shot.key.group[i]);
        if (seen == nullptr) continue;
        poses[i] = {causal_time_, camera_pose(*seen, was_moved(*seen)), true};
        windows[i] = {&poses[i], 1};
    }
    return camera::step(space(), shot.profile, std::span(windows).first(count), causal_time_, shot.group,
                        *shot.outlook);
}

camera::Camera Match::step_group_to(double time, const Shot& shot, camera::GroupState& state) {
    const Timed timed(counters_.step);
    if (!state.started) state.time = time - first_step_s;
    std::array<camera::Window, camera::max_members> windows;
    const std::size_t count = shot.key.group.size();
    for (std::size_t i = 0; i < count; ++i)
        windows[i] = timeline_.window(shot.key.group[i]);
    return camera::step(space(), shot.profile, std::span(windows).first(count), time, state, *shot.outlook);
}

camera::Camera Match::step_to(double time, const Shot& shot, camera::ShotState& state,
                              camera::Scratch& scratch) {
    const Timed timed(counters_.step);
    if (!state.started) state.time = time - first_step_s;
    return camera::step(space(), shot.profile, timeline_.window(shot.target), time, state, scratch,
                        {crowd_, shot.target});
}

}  // namespace camdir::director
