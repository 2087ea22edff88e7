#include "camera/planner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace camdir::camera {
namespace {

constexpr double horizon = 2.5;              // s of a recorded future that are used
constexpr double least_ahead = 0.3;          // s of a recorded future, or the plan is causal
constexpr double knot_interval = 0.15;       // s
constexpr double knot_interval_ahead = 0.1;  // s
constexpr double full_turn = 2.0 * std::numbers::pi;
// Relative.
constexpr double same_step = 1e-3;
constexpr double nearly_same_step = 0.1;
// Time stamps may be rounded to milliseconds: up to 250 Hz that is no reason to drop what is planned. The
// step follows their running mean.
constexpr double stamp_rounding = 1.001e-3;
constexpr double largest_stamp_rounding = 0.25;  // relative
constexpr double step_smoothing = 0.1;

// A plan on a prediction is followed for so long, s, while the player is where they were foreseen, and looks
// there, within so much.
constexpr double followed_for = 1.0 / 30.0;
constexpr float place_as_foreseen = 4.0F;  // units
constexpr float view_as_foreseen = 4.0F * radians_of_a_degree<float>;

// A plan with a recorded future is made anew from knot to knot: one that begins off the grid of knots would
// choose other directions.
std::size_t samples_to_keep(const Plan& plan) {
    const std::size_t wanted = plan.ahead
                                   ? plan.knot_spacing
                                   : std::min(plan.samples_in(followed_for), PlanState::most_on_prediction);
    return std::min({wanted, plan.count(), PlanState::capacity});
}

bool is_as_foreseen(const MapProfile& profile, const PlayerTrack& track,
                    const PlanState::Foreseen& foreseen) {
    return (track.eye - foreseen.eye).norm() <= place_as_foreseen * profile.unit &&
           angle_between(track.view, foreseen.view) <= view_as_foreseen;
}

void make_plan(const freespace::Space& space, const MapProfile& profile, const PlayerTrack& track,
               Window window, const Crowd& crowd, double time, PlanState& state, PlanScratch& scratch) {
    Plan& plan = scratch.plan;
    foresee(space, profile, window, time, state.step, horizon,
            static_cast<float>(state.history[1].heading_yaw), state.balls, plan.future);
    plan.ahead = static_cast<double>(plan.future.known) * state.step > least_ahead;
    plan.knot_spacing = plan.samples_in(plan.ahead ? knot_interval_ahead : knot_interval);

    plan.find_views();
    smooth_heading(profile, state.history, plan);
    Beams beams(space, profile, plan.future, state.free_beams, state.free_lengths, state.balls);
    beams.set_clearance(track.anchor, track.clearance);
    choose_vantages(profile, state.history, beams, crowd, plan, scratch.candidates, state.vantages);
    set_goals(profile, state.vantages, beams, plan);
    refine_path(profile, state.history, beams, plan);
    aim(profile, state.history, plan);

    state.count = samples_to_keep(plan);
    if (state.count > 1 && !std::exchange(state.is_spread, true)) state.count -= state.phase % state.count;
    state.is_predicted = !plan.ahead;
    if (state.is_predicted) {
        for (std::size_t i = 0; i < state.count; ++i)
            state.foreseen[i] = {plan.future[i].eye, plan.view[i]};
    }
    for (std::size_t i = 0; i < state.count; ++i)
        state.samples[i] = {plan.position[i],      plan.eye[i],      plan.heading_yaw[i],
                            plan.heading_pitch[i], plan.look_yaw[i], plan.look_pitch[i]};
}

// What follows the last sample is planned anew.
void discard(PlanState& state) {
    state.free_beams.advance(state.next);
    state.vantages.age += state.next;
    state.count = state.next = 0;
}

// The same, from another camera than the planned one or with another time step.
void begin_anew(PlanState& state) {
    discard(state);
    state.vantages.count = 0;
}

// Keeps the yaws small, without a jump between the two samples.
void unwind(History& history) {
    for (double PlannedSample::*yaw : {&PlannedSample::heading_yaw, &PlannedSample::look_yaw}) {
        const double turns = full_turn * std::round(history[1].*yaw / full_turn);
        history[0].*yaw -= turns;
        history[1].*yaw -= turns;
    }
}

// The sample before the last one as it would have been with another time step.
void resample(History& history, double ratio) {
    PlannedSample& before = history[0];
    const PlannedSample& last = history[1];
    before.position = last.position + ratio * (before.position - last.position);
    before.eye = last.eye + ratio * (before.eye - last.eye);
    for (double PlannedSample::*angle : {&PlannedSample::heading_yaw, &PlannedSample::heading_pitch,
                                         &PlannedSample::look_yaw, &PlannedSample::look_pitch})
        before.*angle = last.*angle + ratio * (before.*angle - last.*angle);
}

// For a step of `dt`.
void keep_time(double dt, PlanState& state) {
    const double off = std::abs(dt - state.step);
    if (off <= same_step * dt) return;
    if (off <= std::max(nearly_same_step * dt, std::min(stamp_rounding, largest_stamp_rounding * dt))) {
        state.step += step_smoothing * (dt - state.step);
        return;
    }
    resample(state.history, dt / state.step);
    begin_anew(state);
    state.step = dt;
    state.is_spread = false;  // a missing frame makes all shots of a match plan
}

}  // namespace

void restart_plan(PlanState& state, const CameraMotion& camera, const PlayerTrack& track, double dt) {
    const Look heading = look_along(track.heading, 0.0F);
    state.history[1] = {camera.position.cast<double>(),
                        track.anchor.cast<double>(),
                        heading.yaw,
                        heading.pitch,
                        camera.look.yaw,
                        camera.look.pitch};
    state.history[0] = state.history[1];
    state.history[0].position -= dt * camera.velocity.cast<double>();
    state.history[0].eye -= dt * track.velocity.cast<double>();
    state.history[0].look_yaw -= wrapped(camera.look.yaw - camera.look_before.yaw);
    state.history[0].look_pitch = camera.look_before.pitch;
    begin_anew(state);
    state.step = dt;
    state.is_spread = false;  // others may begin with it
}

void deviate(PlanState& state, const Vec3f& position, const Vec3f& velocity, const Look& look) {
    PlannedSample& last = state.history[1];
    last.position = position.cast<double>();
    state.history[0].position = last.position - state.step * velocity.cast<double>();
    const double yaw = wrapped(static_cast<float>(look.yaw - last.look_yaw));
    const double pitch = look.pitch - last.look_pitch;
    for (PlannedSample& sample : state.history) {
        sample.look_yaw += yaw;
        sample.look_pitch += pitch;
    }
    begin_anew(state);
}

const PlannedSample& next_sample(const freespace::Space& space, const MapProfile& profile,
                                 const PlayerTrack& track, Window window, const Crowd& crowd, double time,
                                 double dt, PlanState& state, PlanScratch& scratch) {
    keep_time(dt, state);
    const bool is_over = state.next == state.count;
    if (is_over || (state.is_predicted && !is_as_foreseen(profile, track, state.foreseen[state.next]))) {
        discard(state);
        unwind(state.history);
        make_plan(space, profile, track, window, crowd, time, state, scratch);
    }
    state.history[0] = state.history[1];
    state.history[1] = state.samples[state.next++];
    return state.history[1];
}

}  // namespace camdir::camera
