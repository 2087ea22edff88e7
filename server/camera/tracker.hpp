// The tracker: one shot, one player, one camera. What it does in each situation of a match is the same for
// both solvers: the planner, and the heuristic of the paper's section 5.3.
#pragma once

#include <cstdint>
#include <optional>

#include "camera/camera.hpp"
#include "camera/crowd.hpp"
#include "camera/planner.hpp"
#include "camera/player.hpp"
#include "camera/profile.hpp"
#include "camera/spot.hpp"
#include "camera/view.hpp"
#include "camera/window.hpp"
#include "freespace/roadmap.hpp"
#include "freespace/space.hpp"

namespace camdir::camera {

// Everything that a shot remembers between two poses. A value: copy it to branch, replace it to restart.
struct ShotState {
    bool started = false;              // false: the next step with a pose begins with a cut
    bool waiting = false;              // for a first pose, at a spawn point
    std::optional<LineOfAction> line;  // that the cut heeds with which it begins
    PlayerTrack player;
    Vec3f position = Vec3f::Zero();
    Vec3f velocity = Vec3f::Zero();
    std::uint32_t slab = freespace::none;  // of the position
    Look look;
    float lost_for = 0.0F;  // seconds since the player was last seen
    float trapped = 0.0F;   // s: for so long no way out of movers is looked for, where there was none
    double time = 0.0;      // s: of the last step
    SpotMemory spot;        // of the paper's heuristic
    PlanState plan;         // of the planner
    RecentPoses recent;     // of steps by single poses
};

// Memory for the steps of any number of shots on one map, one after the other; one thread at a time.
class Scratch {
  public:
    explicit Scratch(const freespace::Freespace& freespace) : roadmap(freespace) {}
    freespace::RoadmapSearch roadmap;
    PlanScratch plan;
};

// Moves the camera to `time`, later than the last step's, by the solver of the profile. The window holds the
// poses of the player that are known: 0.2 s of history, and of what comes after `time` as much as a delay
// lets be known (2.5 s are used); without any the shot is causal. The time since the last step counts as one
// frame of 60 Hz where it is <= 0, and is limited to 1 ms .. 250 ms.
//
// Guarantees: the camera stays in freespace and moves through freespace, except in a step flagged `cut`,
// which lands in freespace; never a number that is not finite; the same arguments give the same result.
// Among movers, whose poses go by the same clock as `time`: the camera is in none of them, it goes through
// none but in a step flagged `cut`, and target_visible says that none hides the player. Of the space's own
// time nothing is used. Does not allocate, reads no clock. Only a shot that has not had a usable pose yet, or
// a representation without any freespace, has a camera outside (clearance <= 0).
//
//   no pose, or not a number   holds its place; target_absent | held
//   first pose, discontinuity  cut to the best spot
//   dead player                glides to a stop, keeps looking, calmly; held once it stands
//   eye in no slab             follows the last free point on the way to the eye
//   not seen                   searches along the roadmap, after profile.search_time_limit a cut
//
// `crowd`: the match's players. Its windows know as much as `window`.
[[nodiscard]] Camera step(const freespace::Space& space, const Profile& profile, Window window, double time,
                          ShotState& state, Scratch& scratch, const Crowd& crowd = {});

// The same by one pose, `dt` seconds after the last step, for a causal shot: the state keeps what history it
// needs. `pose` is null when the player has none in this frame. A `dt` that is not finite counts as one frame
// too.
[[nodiscard]] Camera step(const freespace::Space& space, const Profile& profile, const Pose* pose, double dt,
                          ShotState& state, Scratch& scratch, const Crowd& crowd = {});

// The shot goes on from `now`, of the time of the last step, and not from where that step came to; `before`
// was `dt` seconds earlier, without a cut between. Returns false, and changes nothing, when no slab covers
// the place or the shot has not had a usable pose yet.
[[nodiscard]] bool go_on_from(const freespace::Space& space, const Profile& profile, const View& before,
                              const View& now, double dt, ShotState& state);

}  // namespace camdir::camera
