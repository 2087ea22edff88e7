// The tracker over a whole trace, as the director would have run it, live or delayed: one shot a player.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "camera/profile.hpp"
#include "camera/spot.hpp"
#include "camera/window.hpp"
#include "evaluation/camera_path.hpp"
#include "evaluation/mover_tracks.hpp"
#include "freespace/freespace.hpp"

namespace camdir::evaluation {

struct Recording {
    CameraPath cameras;                         // of trace.poses
    std::vector<camera::ObjectiveTerms> terms;  // of trace.poses
    std::vector<double> step_nanoseconds;       // CPU time of every camera::step, in no particular order
};

// Steps done and steps in all. Called from several threads.
using ProgressSink = std::function<void(std::uint64_t, std::uint64_t)>;

// Steps a shot for each player through every frame of `trace`, players in parallel; the cameras do not depend
// on the number of threads. A camera knows the poses of `poses` (the same match, at its own rate) up to
// `look_ahead` seconds (>= 0) after its frame; 0: it is causal. Likewise it knows the movers of the
// freespace by `movers`, rows recorded beside `poses`; none: nothing moves. Fails with ErrorCode::interrupted
// soon after `stop` is requested.
[[nodiscard]] Result<Recording> record(const freespace::Freespace& freespace, const camera::Profile& profile,
                                       const Trace& poses, std::span<const MoverRow> movers,
                                       const Trace& trace, double look_ahead, const ProgressSink& progress,
                                       const std::stop_token& stop);

// A shot of a player that begins with a cut.
struct FollowShot {
    std::uint32_t player = 0;
    std::uint32_t first = 0;  // frames of the trace: [first, end)
    std::uint32_t end = 0;
};

// The camera of each of the shot's frames, none where the player has no pose, as a shot begins that is cut to
// at its first frame; that cut is not in them. `tracks`: timed_poses() of all players from the first frame
// on. `line`: of action, which it heeds; may be null. Otherwise as above.
[[nodiscard]] std::vector<std::optional<CameraSample>> record(
    const freespace::Freespace& freespace, const camera::Profile& profile, const Trace& trace,
    std::span<const std::vector<camera::TimedPose>> tracks, std::span<const MoverRow> movers,
    double look_ahead, const FollowShot& shot, const camera::LineOfAction* line);

// CSV with the header t_ms,player,visibility,distance,angle,inertia_distance,inertia_angle,safety,total and a
// row for each pose of the trace: the objective's terms as they entered the sum.
[[nodiscard]] std::string format_terms(const Trace& trace, const Recording& recording);

}  // namespace camdir::evaluation
