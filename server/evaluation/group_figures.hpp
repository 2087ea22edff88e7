// How good a group shot was, judged against the source map.
//
// A counted frame: every member is alive and more than 500 ms after a respawn or teleport. A camera shows a
// player when the segment to their eye is clear, of movers too, and the eye lies in the central 90 % of the
// width and of the height of a picture 90 degrees wide, 16:9.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>

#include "evaluation/camera_path.hpp"
#include "evaluation/metrics.hpp"
#include "evaluation/mover_figures.hpp"
#include "evaluation/placed_movers.hpp"
#include "evaluation/trace.hpp"
#include "oracle/oracle.hpp"

namespace camdir::evaluation {

// Shares are per cent. NaN where there was nothing to measure.
struct GroupFigures {
    std::size_t frames = 0;        // counted
    double together = unmeasured;  // of them: the camera shows every member
    double first = unmeasured;     // of them: the camera shows the first member
    double empty = unmeasured;     // of them: the camera shows none of them
    double possible = unmeasured;  // of them: from some place a camera shows every member, wherever it looks
    double together_of_possible = unmeasured;  // of the possible ones: the camera shows every member
    double provable = unmeasured;  // of the counted: of some such place the sights to all are proved, too
    double together_of_provable = unmeasured;  // of the provable ones: the camera shows every member
    Spread acc;                                // as in Metrics, within counted frames
    Spread ang_speed;
    double comfort = unmeasured;
    double cuts = unmeasured;           // a minute of all frames
    double crossings = unmeasured;      // cuts across the line between two members, likewise
    double clearance_lt4 = unmeasured;  // of all frames
    double fly_through = unmeasured;    // of all steps without a cut
    double pops = unmeasured;           // undeclared steps of more than 64 units, a minute
    // Of all frames and steps; seen through: of counted frames. None: not asked.
    std::optional<MoverFigures> movers;
};

// The movers at a time of the trace. Called from several threads.
using MoversAt = std::function<PlacedMovers(std::int64_t)>;

// Whether a camera can know that the segment between two points is clear where nothing moves: as the
// freespace's sights say. Called from several threads.
using Proves = std::function<bool(const Vec3f&, const Vec3f&)>;

// `cameras`: one for each frame of the trace, of a group of `members`. `places`: what "some place" is. Places
// are looked at in parallel; the result does not depend on the number of threads. `movers`: empty where
// nothing moves. Fails with ErrorCode::interrupted soon after `stop` is requested.
[[nodiscard]] Result<GroupFigures> judge_group(const oracle::Oracle& oracle, double metres_per_unit,
                                               const Trace& trace, std::span<const std::uint32_t> members,
                                               std::span<const CameraSample> cameras,
                                               std::span<const Vec3f> places, const Proves& proves,
                                               const MoversAt& movers, const std::stop_token& stop);

// A JSON object with a key for each figure, as to_json of Metrics.
[[nodiscard]] std::string to_json(const GroupFigures& figures);

// A table of lines `name value unit`.
[[nodiscard]] std::string to_table(const GroupFigures& figures);

}  // namespace camdir::evaluation
