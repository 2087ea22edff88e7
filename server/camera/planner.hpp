// The receding-horizon planner: over the player's known or predicted future it chooses the directions to see
// the player from, smooths the camera's path through them, bends it round what is in the way, and aims. A
// shot without a recorded future is planned in the same way on a prediction.
#pragma once

#include "camera/aim.hpp"
#include "camera/beams.hpp"
#include "camera/candidates.hpp"
#include "camera/heading.hpp"
#include "camera/path.hpp"
#include "camera/player.hpp"
#include "camera/window.hpp"

namespace camdir::camera {

// What a shot remembers of its plan. A value.
struct PlanState {
    static constexpr std::size_t capacity = 64;

    History history;
    std::array<PlannedSample, capacity> samples;  // that follow; planned anew after the last one
    std::size_t count = 0;
    std::size_t next = 0;
    double step = 0.0;  // s, between samples
    FreeBeams free_beams;
    FreeLengths free_lengths;
};

// Memory for planning, for any number of shots one after the other; one thread at a time.
struct PlanScratch {
    Plan plan;
    CandidateScratch candidates;
};

// Starts a plan's history where the camera stands, as if it had moved along with the player.
void restart_plan(PlanState& state, const Vec3f& position, const Look& look, const PlayerTrack& track,
                  double dt);

// The last camera was not where the plan wanted it: the plan goes on from there.
void deviate(PlanState& state, const Vec3f& position, const Vec3f& velocity, const Look& look);

// The next sample of the plan, `dt` after the last one, at `time`, at which the window has a usable pose of a
// living player. The planned positions are wishes: see guard.hpp. Does not allocate.
[[nodiscard]] const PlannedSample& next_sample(const freespace::Freespace& freespace,
                                               const MapProfile& profile, Window window, double time,
                                               double dt, PlanState& state, PlanScratch& scratch);

}  // namespace camdir::camera
