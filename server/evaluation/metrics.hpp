// How good a camera was, judged against the source map and never against a VFS-rep.
//
// A counted frame: the player is alive and more than 500 ms after a respawn or teleport. All players are
// pooled; rates are per minute of a living player. Lengths below are units of 0.0254 m and scale with the
// map's metres_per_unit; d_opt = 120, P = the camera's position, e = the eye, f = the player's view
// direction.
#pragma once

#include <optional>
#include <span>
#include <stop_token>

#include "evaluation/judgement.hpp"
#include "evaluation/mover_figures.hpp"

namespace camdir::evaluation {

struct Spread {
    double rms = unmeasured;
    double p95 = unmeasured;
    double p99 = unmeasured;
};

// Shares are per cent, lengths map units, angles degrees. NaN where there was nothing to measure.
struct Metrics {
    // Of counted frames.
    double good = unmeasured;  // P-e clear, e in frame, clearance >= 4, abs(|e-P| - d_opt) <= d_opt/2,
                               // angle(e-P, f) <= 60 degrees
    double visible_head = unmeasured;  // P-e clear
    double visible_body = unmeasured;  // mean share of the player's box seen: 8 corners pulled in, and centre
    double clearance_lt4 = unmeasured;  // clearance < 4
    double in_solid = unmeasured;       // inside a solid, or outside the sealed map
    double fly_through = unmeasured;    // steps without a cut whose segment is not clear
    double dist_err = unmeasured;       // mean abs(|e-P| - d_opt)
    double dist_err_p95 = unmeasured;
    double too_close = unmeasured;  // |e-P| < d_opt / 3
    double behind = unmeasured;     // mean angle(e-P, f)
    double behind_p95 = unmeasured;
    double in_frame = unmeasured;  // e in the central 60 % of a 90 degrees wide 16:9 view

    // Within segments, which end at cuts, deaths and uncounted frames; seconds in the denominators.
    Spread acc;
    Spread jerk;
    Spread ang_speed;
    Spread ang_acc;
    double comfort = unmeasured;  // frames, but a segment's first, with ang_speed <= 120 degrees/s in which a
                                  // distant background has crossed the picture's centre at less than half the
                                  // picture's width a second: see Motion::comfortable
    double max_rotation = unmeasured;  // the largest turn between two frames

    // Of all frames of a living player.
    double pops = unmeasured;            // undeclared steps beyond max(64, 3 x the eye's step), a minute
    double max_speed = unmeasured;       // the largest undeclared speed
    double cuts = unmeasured;            // declared, a minute, without those below
    double cuts_at_events = unmeasured;  // declared, up to 100 ms after a respawn or teleport, a minute

    std::optional<double> kill_in_view;  // % of the followed players' kills: kill_in_view(); none: not asked
    std::optional<MoverFigures>
        movers;  // judge_movers(); none: not asked. The rest is of the map without them
};

// All but kill_in_view and movers, of any set of judgements: all players together, or some.
[[nodiscard]] Metrics summarise(std::span<const Judgement> judgements);

// The same of the cameras of a trace, as judge(). Explores the scene first, with `progress`; fails as
// oracle::ReachedGrid::explore. Precondition: `oracle` is that of `scene`.
[[nodiscard]] Result<Metrics> measure(const scene::Scene& scene, const oracle::Oracle& oracle,
                                      const Trace& trace, std::span<const CameraSample> cameras,
                                      const oracle::ExploreProgress& progress, const std::stop_token& stop);

}  // namespace camdir::evaluation
