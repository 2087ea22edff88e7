// A group shot over a whole trace, as the director would have run it.
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "camera/profile.hpp"
#include "evaluation/camera_path.hpp"
#include "evaluation/mover_tracks.hpp"
#include "evaluation/trace.hpp"
#include "freespace/freespace.hpp"

namespace camdir::evaluation {

struct GroupRecording {
    CameraPath cameras;                    // one for each frame of the trace
    std::vector<double> step_nanoseconds;  // CPU time, likewise
};

// The shot of `members` (players of the trace, at most camera::max_members, those who matter most first)
// through every frame of `trace`; `poses`, `movers` and `look_ahead` as in record(). Fails with
// ErrorCode::interrupted soon after `stop` is requested.
[[nodiscard]] Result<GroupRecording> record_group(const freespace::Freespace& freespace,
                                                  const camera::Profile& profile, const Trace& poses,
                                                  std::span<const MoverRow> movers, const Trace& trace,
                                                  std::span<const std::uint32_t> members, double look_ahead,
                                                  const std::stop_token& stop);

}  // namespace camdir::evaluation
