#include "evaluation/recording.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <charconv>
#include <ctime>
#include <memory>
#include <utility>

#include "base/parallel.hpp"
#include "camera/tracker.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::uint64_t max_updates = 200'000'000;

constexpr double history = 0.5;     // s of poses before a camera that it is given
constexpr double same_time = 1e-9;  // s

camera::Pose tracked(const TracePose& pose) {
    camera::Pose seen;
    seen.eye = pose.eye.cast<float>();
    seen.orientation = pose.orientation.cast<float>().normalized();
    seen.velocity = pose.velocity.cast<float>();
    seen.alive = pose.alive;
    seen.discontinuity = pose.discontinuity;
    return seen;
}

double seconds(std::int64_t nanoseconds) {
    return static_cast<double>(nanoseconds) * 1e-9;
}

// All poses of a player; times from `start`, ns.
std::vector<camera::TimedPose> timed_poses(const Trace& trace, std::uint32_t player, std::int64_t start) {
    std::vector<camera::TimedPose> poses;
    poses.reserve(trace.frames.size());
    const auto track = track_of(trace, player);
    for (std::size_t frame = 0; frame < track.size(); ++frame) {
        const bool present = track[frame] != absent;
        poses.push_back({seconds(trace.frames[frame].time - start),
                         present ? tracked(trace.poses[track[frame]]) : camera::Pose{}, present});
    }
    return poses;
}

// The part of a player's poses that is known at a time which ascends from call to call.
class KnownPoses {
  public:
    KnownPoses(camera::Window all, double look_ahead) : all_(all), look_ahead_(look_ahead) {}

    [[nodiscard]] camera::Window at(double time) {
        while (end_ < all_.size() && all_[end_].time <= time + look_ahead_ + same_time)
            ++end_;
        while (first_ + 1 < end_ && all_[first_ + 1].time <= time - history)
            ++first_;
        return all_.subspan(first_, end_ - first_);
    }

  private:
    camera::Window all_;
    double look_ahead_;
    std::size_t first_ = 0;
    std::size_t end_ = 0;
};

CameraSample sampled(const camera::Camera& camera, bool cut) {
    return {camera.position.cast<double>(), camera.orientation.cast<double>().normalized(), cut};
}

// Of this thread alone: unlike wall time, the same on a busy machine.
double cpu_nanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

// Records one player at a time; several recorders may share a recording.
class Recorder {
  public:
    Recorder(const freespace::Freespace& freespace, const camera::Profile& profile, const Trace& poses,
             const Trace& trace, double look_ahead, Recording& recording)
        : freespace_(freespace),
          profile_(profile),
          poses_(poses),
          trace_(trace),
          look_ahead_(look_ahead),
          recording_(recording),
          scratch_(std::make_unique<camera::Scratch>(freespace)) {}

    // Calls `keep_on` before every frame and stops when it returns false. `nanoseconds` has one element a
    // frame.
    template <class KeepOn>
    void follow(std::uint32_t player, double* nanoseconds, const KeepOn& keep_on) {
        const std::int64_t start = std::min(poses_.frames.front().time, trace_.frames.front().time);
        const auto poses = timed_poses(poses_, player, start);
        KnownPoses known(poses, look_ahead_);
        camera::ShotState state;
        bool cut_unseen = false;  // a cut while the player had no pose: goes into the next row
        const auto track = track_of(trace_, player);
        for (std::size_t frame = 0; frame < track.size() && keep_on(); ++frame) {
            const double time = seconds(trace_.frames[frame].time - start);
            const camera::Window window = known.at(time);
            const double before = cpu_nanoseconds();
            const camera::Camera camera = camera::step(freespace_, profile_, window, time, state, *scratch_);
            nanoseconds[frame] = cpu_nanoseconds() - before;
            cut_unseen = cut_unseen || (camera.flags & camera::cut) != 0;
            if (track[frame] == absent) continue;
            recording_.cameras[track[frame]] = sampled(camera, std::exchange(cut_unseen, false));
            recording_.terms[track[frame]] = camera.objective;
        }
    }

  private:
    const freespace::Freespace& freespace_;
    const camera::Profile& profile_;
    const Trace& poses_;
    const Trace& trace_;
    double look_ahead_;
    Recording& recording_;
    std::unique_ptr<camera::Scratch> scratch_;
};

void append(std::string& text, float value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    text += ',';
    text.append(digits.data(), end.ptr);
}

}  // namespace

Result<Recording> record(const freespace::Freespace& freespace, const camera::Profile& profile,
                         const Trace& poses, const Trace& trace, double look_ahead,
                         const ProgressSink& progress, const std::stop_token& stop) {
    assert(look_ahead >= 0.0 && !poses.frames.empty());
    const std::size_t frames = trace.frames.size();
    const std::uint64_t total = std::uint64_t{frames} * trace.players.size();
    if (total > max_updates)
        return fail("the trace has " + std::to_string(total) + " updates (frames times players); at most " +
                    std::to_string(max_updates) + " are accepted");
    Recording recording;
    recording.cameras.resize(trace.poses.size());
    recording.terms.resize(trace.poses.size());
    recording.step_nanoseconds.resize(total);
    std::atomic<std::uint64_t> done = 0;
    const auto keep_on = [&] {
        constexpr std::uint64_t stride = 1024;
        const std::uint64_t count = done.fetch_add(1, std::memory_order_relaxed) + 1;
        if (count % stride == 0) progress(count, total);
        return !stop.stop_requested();
    };
    parallel_for(std::size_t{0}, trace.players.size(), [&](std::size_t i) {
        Recorder recorder(freespace, profile, poses, trace, look_ahead, recording);
        recorder.follow(trace.players[i], recording.step_nanoseconds.data() + i * frames, keep_on);
    });
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    return recording;
}

std::string format_terms(const Trace& trace, const Recording& recording) {
    assert(recording.terms.size() == trace.poses.size());
    std::string text = "t_ms,player,visibility,distance,angle,inertia_distance,inertia_angle,safety,total\n";
    for (const TraceFrame& frame : trace.frames) {
        const std::string time = format_milliseconds(frame.time);
        for (std::uint32_t i = frame.first_pose; i < frame.first_pose + frame.pose_count; ++i) {
            const camera::ObjectiveTerms& terms = recording.terms[i];
            text += time + ',' + std::to_string(trace.poses[i].player);
            for (const float term : {terms.visibility, terms.distance, terms.angle, terms.inertia_distance,
                                     terms.inertia_angle, terms.safety, terms.total})
                append(text, term);
            text += '\n';
        }
    }
    return text;
}

}  // namespace camdir::evaluation
