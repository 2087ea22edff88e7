// What the judge says about each frame of a camera: the figures of metrics.hpp summarise it, and pages and
// pictures show it, so that what they show is what was counted.
#pragma once

#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "evaluation/camera_path.hpp"
#include "evaluation/motion.hpp"
#include "evaluation/trace.hpp"
#include "oracle/reachability.hpp"
#include "scene/scene.hpp"

namespace camdir::evaluation {

// The limits of a good frame, map units.
struct Thresholds {
    explicit Thresholds(double metres_per_unit) : unit(metres_of_nominal_unit / metres_per_unit) {}

    double unit;                     // 0.0254 m
    double distance = 120.0 * unit;  // d_opt
    double distance_error = distance / 2.0;
    double too_close = distance / 3.0;
    double clearance = 4.0 * unit;
    double largest_clearance = 32.0 * unit;  // what is farther from obstacles is not told apart
    double pop = 64.0 * unit;
    double behind = 60.0;  // degrees
};

// What keeps a frame from being good.
enum Fault : std::uint8_t {
    hidden = 1,          // the eye is
    out_of_frame = 2,    // the eye is not in the middle of the picture
    low_clearance = 4,   // the camera is near an obstacle or in one
    wrong_distance = 8,  // too far from d_opt
    wrong_side = 16,     // too far off the player's view direction
};

inline constexpr int body_point_count = 9;  // corners and centre of a player's box

// Of one camera of a player. Map units, degrees, seconds; `unmeasured` where a value has no meaning.
struct Judgement {
    bool alive = false;
    bool counted = false;       // alive and settled
    bool cut = false;           // declared, while alive
    bool cut_at_event = false;  // a cut shortly after a respawn or teleport

    // Of counted frames.
    std::uint8_t faults = 0;       // of Fault; 0: good
    std::uint8_t body_points = 0;  // seen, of body_point_count
    bool in_solid = false;
    bool too_close = false;
    double distance = unmeasured;        // from the eye
    double distance_error = unmeasured;  // from d_opt
    double behind = unmeasured;          // the angle off the view direction
    double clearance = unmeasured;       // 0 in a solid; at most Thresholds::largest_clearance

    // Of the step from the frame before, when the player lived in both.
    double step_seconds = unmeasured;
    double speed = unmeasured;  // of undeclared steps, as the rest
    bool pop = false;
    bool judged_step = false;  // both frames are counted
    bool fly_through = false;

    Motion motion;  // of counted frames
};

// judgements[i] is of cameras[i], a camera of trace.poses[i]. Players are judged in parallel; the result does
// not depend on the number of threads. Fails with ErrorCode::interrupted soon after `stop` is requested.
// Preconditions: one camera a pose; `oracle` and `reachability` are of one scene.
[[nodiscard]] Result<std::vector<Judgement>> judge(const oracle::Oracle& oracle,
                                                   const oracle::Reachability& reachability,
                                                   const Thresholds& thresholds, const Trace& trace,
                                                   std::span<const CameraSample> cameras,
                                                   const std::stop_token& stop);

}  // namespace camdir::evaluation
