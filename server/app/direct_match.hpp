// A recorded match as the direction sees it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string_view>
#include <vector>

#include "app/recorded_movers.hpp"
#include "base/error.hpp"
#include "direction/editor.hpp"
#include "direction/footage.hpp"
#include "direction/programme.hpp"
#include "direction/rules.hpp"
#include "evaluation/camera_path.hpp"
#include "evaluation/events.hpp"
#include "freespace/fixed_shots.hpp"
#include "freespace/freespace.hpp"

namespace camdir::app {

// The segment between two points meets no obstacle that stands still. Called from several threads.
using ClearLine = std::function<bool(const Vec3d&, const Vec3d&)>;

// The beat of the footage that has a time of the trace.
[[nodiscard]] direction::Beat beat_at(const evaluation::Trace& trace, std::int64_t time);

// Fails when the match is so long that its footage would take too much memory: 11 h of 8 players, 3 h of 32
// take gigabytes.
[[nodiscard]] Result<void> check_length(const evaluation::Trace& trace);

// Players in the order of `trace.players`; rush r is the camera of player r, after them come those of
// `fixed`, which show nobody farther away than freespace::fixed_shot_range. A player is shown in a beat when
// in all of its frames the eye or the centre of their box is in the picture with a clear line from the
// camera, past `movers` too. A beat without a frame repeats the one before, without its cuts. Fails with
// ErrorCode::interrupted soon after `stop` is requested. Preconditions: one camera a pose, a length that
// check_length() takes.
[[nodiscard]] Result<direction::Footage> footage_of(const evaluation::Trace& trace,
                                                    const RecordedMovers& movers,
                                                    const evaluation::CameraPath& cameras,
                                                    std::span<const freespace::FixedShot> fixed, double unit,
                                                    const ClearLine& clear, const std::stop_token& stop);

// The same as the running director knows it: beats of their first frames, seen by the cameras of its scout.
// With the first `fixed_shots` of the freespace. Likewise.
[[nodiscard]] Result<direction::Footage> scouted_footage_of(const evaluation::Trace& trace,
                                                            const RecordedMovers& movers,
                                                            const freespace::Freespace& freespace,
                                                            std::size_t fixed_shots, double unit,
                                                            const std::stop_token& stop);

// Fixed cameras do not begin where a mover comes near within the shortest shot, and end before one is near,
// both as far as `delay_s` lets it be known. Empty where nothing moves; incomplete soon after `stop` is
// requested.
[[nodiscard]] direction::MayShow out_of_the_way(const evaluation::Trace& trace, const RecordedMovers& movers,
                                                const freespace::Freespace& freespace,
                                                std::span<const freespace::FixedShot> fixed, double unit,
                                                const direction::Grammar& grammar, double delay_s,
                                                const std::stop_token& stop);

// The cameras of all players' poses, those of a running director's shots as they begin with a cut, until
// after the beat in which the next shot begins. `cameras`: of cameras that run all the time. Ends early, with
// some of them, soon after `stop` is requested.
[[nodiscard]] evaluation::CameraPath cameras_of_programme(
    const evaluation::Trace& trace, const RecordedMovers& movers, const freespace::Freespace& freespace,
    const direction::Footage& footage, std::span<const freespace::FixedShot> fixed,
    std::span<const direction::Shot> shots, double look_ahead, evaluation::CameraPath cameras,
    const std::stop_token& stop);

// Whether the direction knows events of this kind, as tables name it.
[[nodiscard]] bool directs_by(std::string_view kind);

// The events that the direction knows, times from the trace's first frame; events before it are left out.
[[nodiscard]] std::vector<direction::Event> events_of(const evaluation::Trace& trace,
                                                      const std::vector<evaluation::TraceEvent>& events);

}  // namespace camdir::app
