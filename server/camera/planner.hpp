// The receding-horizon planner: over the player's known or predicted future it chooses the directions to see
// the player from, smooths the camera's path through them, bends it round what is in the way, and aims. A
// shot without a recorded future is planned in the same way on a prediction.
#pragma once

#include <array>

#include "camera/aim.hpp"
#include "camera/beams.hpp"
#include "camera/candidates.hpp"
#include "camera/crowd.hpp"
#include "camera/heading.hpp"
#include "camera/path.hpp"
#include "camera/player.hpp"
#include "camera/window.hpp"

namespace camdir::camera {

// What a shot remembers of its plan. A value.
struct PlanState {
    static constexpr std::size_t capacity = 64;
    static constexpr std::size_t most_on_prediction = 8;  // samples that are followed
    struct Foreseen {
        Vec3f eye;
        Vec3f view;  // direction
    };

    History history;
    std::array<PlannedSample, capacity> samples;  // that follow; planned anew after the last one
    std::size_t count = 0;
    std::size_t next = 0;
    bool is_predicted = false;
    std::array<Foreseen, most_on_prediction> foreseen;  // the player at each sample of what is predicted
    double step = 0.0;                                  // s, between samples
    std::uint32_t phase = 0;  // any number: shots that planned together plan in different frames by it
    bool is_spread = false;   // `phase` has shortened a plan since
    Vantages vantages;
    FreeBeams free_beams;
    FreeLengths free_lengths;
    freespace::RecentBalls balls;
};

// Memory for planning, for any number of shots one after the other; one thread at a time.
struct PlanScratch {
    Plan plan;
    CandidateScratch candidates;
};

// A camera that no plan made, and the view of the one before it.
struct CameraMotion {
    Vec3f position;
    Vec3f velocity;
    Look look_before;
    Look look;
};

// Plans begin anew from this camera, which follows the player as they are now.
void restart_plan(PlanState& state, const CameraMotion& camera, const PlayerTrack& track, double dt);

// The guard moved the last camera off the plan, which goes on from there, turning as it was.
void deviate(PlanState& state, const Vec3f& position, const Vec3f& velocity, const Look& look);

// The next sample of the plan, `dt` after the last one, at `time`, at which the window has a usable pose of a
// living player, `track`. The planned positions are wishes: see guard.hpp. Does not allocate.
[[nodiscard]] const PlannedSample& next_sample(const freespace::Space& space, const MapProfile& profile,
                                               const PlayerTrack& track, Window window, const Crowd& crowd,
                                               double time, double dt, PlanState& state,
                                               PlanScratch& scratch);

}  // namespace camdir::camera
