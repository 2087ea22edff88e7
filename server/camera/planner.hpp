// The receding-horizon planner: over the player's known or predicted future it chooses directions to see the
// player from, smooths the camera's path through them, and bends it round what is in the way.
#pragma once

#include <array>

#include "camera/future.hpp"
#include "camera/player.hpp"
#include "camera/profile.hpp"
#include "camera/programme.hpp"
#include "camera/smoother.hpp"
#include "camera/window.hpp"

namespace camdir::camera {

// The camera and what it follows, at one instant.
struct PlannedSample {
    Vec3d position = Vec3d::Zero();
    Vec3d eye = Vec3d::Zero();  // smoothed
    double heading_yaw = 0.0;   // smoothed view of the player, rad
    double heading_pitch = 0.0;
    double look_yaw = 0.0;  // of the camera, rad
    double look_pitch = 0.0;
};

// What a shot remembers of its plan.
struct PlanState {
    static constexpr std::size_t capacity = 64;

    std::array<PlannedSample, 2> history;  // the last two cameras, the last one second
    std::array<PlannedSample, capacity> ahead;
    std::size_t count = 0;  // of `ahead`
    std::size_t next = 0;
    double step = 0.0;  // s, between samples
};

// Memory for planning, for any number of shots one after the other.
struct PlanScratch {
    Future future;
    Programme programme;
    Smoother smoother;
    std::array<Programme::DirectionCosts, Programme::knots> direction_costs;
    std::array<double, Future::capacity> weights;
    std::array<double, Future::capacity> values;
    std::array<double, Future::capacity> yaw;
    std::array<double, Future::capacity> pitch;
    std::array<Vec3d, Future::capacity> eyes;
    std::array<Vec3d, Future::capacity> targets;
    std::array<Vec3d, Future::capacity> path;
    std::array<double, Future::capacity> lengths;
    std::array<double, Future::capacity> base;
    std::array<double, Future::capacity> goals;
    std::array<double, Future::capacity> yaw2;
    std::array<double, Future::capacity> pitch2;
    std::array<float, Future::capacity> radius;
};

// Starts a plan's history where the camera stands, as if it had moved along with the player.
void restart(PlanState& plan, const Vec3f& position, const Look& look, const PlayerTrack& track, double dt);
// The last camera was not where the plan wanted it: it goes on from there with this velocity.
void deviate(PlanState& plan, const Vec3f& position, const Vec3f& velocity, const Look& look);

// The next sample of the plan, at `time`, `dt` after the last one. The recorded future is used up to `horizon`.
[[nodiscard]] const PlannedSample& next_sample(const freespace::Freespace& freespace,
                                               const MapProfile& profile, Window window, double time,
                                               double dt, double horizon, PlanState& plan,
                                               PlanScratch& scratch);

}  // namespace camdir::camera
