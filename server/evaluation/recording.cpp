#include "evaluation/recording.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <charconv>
#include <memory>
#include <utility>

#include "base/parallel.hpp"
#include "camera/tracker.hpp"
#include "evaluation/replay.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::uint64_t max_updates = 200'000'000;

// Records one player at a time; several recorders may share a recording.
class Recorder {
  public:
    // `tracks`: of the players of `poses`.
    Recorder(const freespace::Freespace& freespace, const camera::Profile& profile, const Trace& poses,
             std::span<const std::vector<camera::TimedPose>> tracks, std::span<const MoverRow> movers,
             const Trace& trace, double look_ahead, Recording& recording)
        : freespace_(freespace),
          profile_(profile),
          poses_(poses),
          tracks_(tracks),
          movers_(movers),
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
        KnownCrowd known_crowd(poses_, tracks_, look_ahead_);
        KnownMovers known_movers(freespace_, movers_, poses_, start, look_ahead_);
        camera::ShotState state;
        bool cut_unseen = false;  // a cut while the player had no pose: goes into the next row
        const auto track = track_of(trace_, player);
        for (std::size_t frame = 0; frame < track.size() && keep_on(); ++frame) {
            const double time = seconds(trace_.frames[frame].time - start);
            const camera::Window window = known.at(time);
            const freespace::Space space(freespace_, movers_.empty() ? nullptr : &known_movers.at(time));
            const camera::Crowd crowd = known_crowd.at(time, player);
            const double before = cpu_nanoseconds();
            const camera::Camera camera =
                camera::step(space, profile_, window, time, state, *scratch_, crowd);
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
    std::span<const std::vector<camera::TimedPose>> tracks_;
    std::span<const MoverRow> movers_;
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
                         const Trace& poses, std::span<const MoverRow> movers, const Trace& trace,
                         double look_ahead, const ProgressSink& progress, const std::stop_token& stop) {
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
    const auto tracks =
        timed_poses_of_all(poses, std::min(poses.frames.front().time, trace.frames.front().time));
    parallel_for(std::size_t{0}, trace.players.size(), [&](std::size_t i) {
        Recorder recorder(freespace, profile, poses, tracks, movers, trace, look_ahead, recording);
        recorder.follow(trace.players[i], recording.step_nanoseconds.data() + i * frames, keep_on);
    });
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    return recording;
}

std::vector<std::optional<CameraSample>> record(const freespace::Freespace& freespace,
                                                const camera::Profile& profile, const Trace& trace,
                                                std::span<const std::vector<camera::TimedPose>> tracks,
                                                std::span<const MoverRow> movers, double look_ahead,
                                                const FollowShot& shot, const camera::LineOfAction* line) {
    assert(shot.first <= shot.end && shot.end <= trace.frames.size());
    const std::int64_t start = trace.frames.front().time;
    const auto player = std::ranges::lower_bound(trace.players, shot.player) - trace.players.begin();
    const auto track = track_of(trace, shot.player);
    const auto scratch = std::make_unique<camera::Scratch>(freespace);
    KnownPoses known(tracks[static_cast<std::size_t>(player)], look_ahead);
    KnownCrowd crowd(trace, tracks, look_ahead);
    KnownMovers known_movers(freespace, movers, trace, start, look_ahead);
    camera::ShotState state;
    if (line != nullptr) state.line = *line;
    std::vector<std::optional<CameraSample>> cameras(shot.end - shot.first);
    for (std::uint32_t frame = shot.first; frame < shot.end; ++frame) {
        const double time = seconds(trace.frames[frame].time - start);
        if (frame == shot.first) state.time = time - camera::usable_frame(0.0);
        const freespace::Space space(freespace, movers.empty() ? nullptr : &known_movers.at(time));
        const camera::Camera camera =
            camera::step(space, profile, known.at(time), time, state, *scratch, crowd.at(time, shot.player));
        const bool cut = frame != shot.first && (camera.flags & camera::cut) != 0;
        if (track[frame] != absent) cameras[frame - shot.first] = sampled(camera, cut);
    }
    return cameras;
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
