// A recorded match as the direction sees it.
#pragma once

#include <functional>
#include <vector>

#include "base/error.hpp"
#include "direction/footage.hpp"
#include "direction/rules.hpp"
#include "evaluation/camera_path.hpp"
#include "evaluation/events.hpp"

namespace camdir::app {

// The segment between two points meets no obstacle. Called from several threads.
using ClearLine = std::function<bool(const Vec3d&, const Vec3d&)>;

// Players and rushes in the order of `trace.players`: rush r is the camera of player r. A player is shown in
// a beat when in all of its frames the eye or the centre of their box is in the picture with a clear line
// from the camera. A beat without a frame repeats the one before. Fails when the match has more than
// 4,000,000 beats of players (14 h of 8). Precondition: one camera a pose.
[[nodiscard]] Result<direction::Footage> footage_of(const evaluation::Trace& trace,
                                                    const evaluation::CameraPath& cameras, double unit,
                                                    const ClearLine& clear);

// The events that the direction knows, times from the trace's first frame; events before it are left out.
[[nodiscard]] std::vector<direction::Event> events_of(const evaluation::Trace& trace,
                                                      const std::vector<evaluation::TraceEvent>& events);

}  // namespace camdir::app
