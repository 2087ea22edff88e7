#include "camera/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "camera/cut.hpp"
#include "camera/evade.hpp"
#include "camera/guard.hpp"
#include "camera/moves.hpp"
#include "camera/objective.hpp"
#include "camera/reach.hpp"
#include "camera/regain.hpp"
#include "camera/search.hpp"
#include "camera/spot.hpp"

namespace camdir::camera {
namespace {

constexpr float greatest_urgency = 1e6F;
constexpr float at_rest = 1.0F;     // units/s
constexpr float at_the_eye = 1.0F;  // units: nearer, there is no line of sight to look along
constexpr float quarter_turn = std::numbers::pi_v<float> / 2.0F;
// Of a dead player, in rad/s: bodies fly past the camera, and what happened is where they come from.
constexpr float turn_limit_after_death = quarter_turn;
// Where movers are everywhere, a way out is looked for every so many seconds: that takes long.
constexpr float time_between_ways_out = 0.25F;

// One step of one shot.
class Step {
  public:
    Step(const freespace::Space& space, const Profile& profile, double dt, ShotState& state, Scratch& scratch,
         Window window, const Crowd& crowd, double time)
        : space_(space.in_step(state.time, time)),
          profile_(profile, space.map().metadata().metres_per_unit),
          dt_(usable_frame(dt)),
          look_before_(state.look),
          state_(state),
          player_(state.player),
          scratch_(scratch),
          window_(window),
          crowd_(crowd),
          time_(time) {}

    Camera with_pose(const Pose& pose) {
        if (!state_.started || pose.discontinuity) {
            restart(space_, profile_, pose, player_);
            return cut_to_player();
        }
        follow(space_, profile_, pose, dt_, player_);
        if (!pose.alive) return come_to_rest();
        if (state_.lost_for > profile_.search_time_limit && player_.covered) return cut_to_player();
        if (state_.lost_for > 0.0F) return search();
        return profile_.solver == Solver::planner ? follow_plan() : keep_in_sight();
    }

    Camera without_pose() {
        if (state_.started || state_.waiting) return hold(target_absent);
        wait_at_spawn_point();
        return hold(target_absent | cut);
    }

  private:
    // The planner's step.
    Camera follow_plan() {
        const PlannedSample& planned =
            next_sample(space_, profile_, player_, window_, crowd_, time_, dt_, state_.plan, scratch_.plan);
        const Vec3f wanted = planned.position.cast<float>();
        const Look look{wrapped(static_cast<float>(planned.look_yaw)),
                        static_cast<float>(planned.look_pitch)};
        const auto place = guarded(space_, profile_, player_, motion(), wanted, state_.plan.balls);
        if (!place) return search();
        const bool as_planned = place->position == wanted;
        const Motion before = motion();
        state_.velocity =
            as_planned ? Vec3f((wanted - state_.position) / dt_) : player_.velocity;  // a rescue is no motion
        settle(*place);
        state_.lost_for = 0.0F;
        const Look aimed = as_planned ? look : moved_along(look, wanted, place->position);
        state_.look = turned(state_.look, aimed, 1.0F, profile_.turn_limit * dt_);
        if (!as_planned) deviate(state_.plan, state_.position, state_.velocity, state_.look);
        return frame(*place, before, out_of_reach() ? std::uint32_t{searching} : 0U);
    }

    // The paper's step.
    Camera keep_in_sight() {
        const Spot spot = spot_to_move_to(space_, profile_, player_, state_.position, dt_, state_.spot);
        Vec3f position = state_.position;
        Vec3f wanted = position;
        for (int i = 0; i < static_cast<int>(profile_.iterations); ++i) {
            wanted =
                within_reach(position + average_when_seen(profile_, moves(spot, position), speed(), dt_));
            const auto reached = reach_shortened(space_, profile_, player_, state_.position, wanted);
            if (!reached) break;
            if (acceptable(profile_, player_, *reached)) return move_to(*reached);
            position = reached->position;
        }
        const auto seen = regain_sight(space_, profile_, player_, motion(), wanted);
        if (!seen) return search();
        const Camera camera = move_to(*seen);
        state_.velocity = player_.velocity;  // a rescue is no motion to go on with
        return camera;
    }

    Camera search() {
        const Spot spot = spot_to_move_to(space_, profile_, player_, state_.position, dt_, state_.spot);
        Moves all = moves(spot, state_.position);
        all.visibility =
            next_on_the_way(space_, profile_, player_, state_.position, scratch_.roadmap) - state_.position;
        const float urgency = std::min(greatest_urgency, std::exp(profile_.search_growth * state_.lost_for));
        const Vec3f move = average_when_lost(profile_, all, urgency, dt_);
        // Where the average would scrape along an obstacle, straight to the roadmap, however narrow its way
        // is.
        const float kept = kept_clearance(profile_, player_);
        std::optional<Candidate> next;
        for (const Vec3f& wanted : {move, all.visibility}) {
            next = reach_shortened(space_, profile_, player_, state_.position,
                                   within_reach(state_.position + wanted));
            if (next && next->room >= kept) break;
        }
        if (next && room_soon(space_, next->position, kept) >= kept) return move_to(*next);
        state_.lost_for += dt_;
        turn();
        return hold(searching);
    }

    // A dead player: the camera glides on ever slower, then holds, and looks after them without haste.
    Camera come_to_rest() {
        turn_limit_ = std::min(turn_limit_, turn_limit_after_death);
        const Vec3f velocity = state_.velocity * std::exp(-dt_ / profile_.motion_smoothing);
        if (velocity.norm() > at_rest * profile_.unit) {
            const Vec3f wanted = within_reach(state_.position + velocity * dt_);
            const auto reached = reach(space_, profile_, player_, state_.position, wanted);
            if (reached && reached->room >= kept_clearance(profile_, player_)) return move_to(*reached);
        }
        turn();
        return hold(0);
    }

    Camera cut_to_player() {
        const auto line = std::exchange(state_.line, std::nullopt);
        const Candidate spot = landing(space_, profile_, player_, line ? &*line : nullptr);
        state_.started = true;
        settle(spot);
        state_.velocity = player_.velocity;
        state_.lost_for = 0.0F;
        state_.look = wanted_look();
        restart_plan(state_.plan, {state_.position, state_.velocity, state_.look, state_.look}, player_, dt_);
        return frame(spot, standing(), cut);
    }

    Camera move_to(const Candidate& next) {
        const Motion before = motion();
        const bool lost = !is_seen(next);
        state_.velocity = (next.position - state_.position) / dt_;
        settle(next);
        state_.lost_for = lost ? state_.lost_for + dt_ : 0.0F;
        turn();
        plan_from_here();
        return frame(next, before, lost || out_of_reach() ? std::uint32_t{searching} : 0U);
    }

    void plan_from_here() {
        restart_plan(state_.plan, {state_.position, state_.velocity, look_before_, state_.look}, player_,
                     dt_);
    }

    void settle(const Candidate& place) {
        state_.position = place.position;
        state_.slab = place.slab;
        state_.trapped = 0.0F;
    }

    // It keeps its place, unless a mover comes there.
    Camera hold(std::uint32_t flags) {
        state_.velocity = Vec3f::Zero();
        const float kept = kept_clearance(profile_, player_);
        if (is_threatened(space_, state_.position, kept))
            flags |= make_way(kept);
        else
            state_.trapped = 0.0F;
        plan_from_here();
        const auto place = look_up(space_, profile_, player_, state_.position);
        const Candidate uncovered{state_.position};
        return frame(place ? *place : uncovered, standing(), flags | held);
    }

    // For a mover. Returns the flag of the step, if any.
    std::uint32_t make_way(float clearance) {
        state_.trapped -= dt_;
        if (state_.trapped > 0.0F) return 0;
        if (const auto place = evade(space_, state_.position, clearance, profile_.step_limit)) {
            state_.position = *place;
            state_.slab = freespace::distance(space_, *place).triangle;
            return 0;
        }
        settle(landing(space_, profile_, player_));
        if (room_soon(space_, state_.position, clearance) <= 0.0F) state_.trapped = time_between_ways_out;
        return cut;
    }

    // Before the first pose: at the map's first spawn point, looking as its players do.
    void wait_at_spawn_point() {
        state_.waiting = true;
        state_.line.reset();
        if (space_.map().spawn_points().empty()) return;
        const freespace::SpawnPoint& spawn = space_.map().spawn_points().front();
        Pose pose;
        pose.eye = spawn.eye;
        restart(space_, profile_, pose, player_);
        state_.position = player_.anchor;
        state_.slab = player_.slab;
        state_.look = {spawn.yaw, 0.0F};
    }

    [[nodiscard]] Camera frame(const Candidate& place, const Motion& before, std::uint32_t flags) const {
        const bool visible = player_.covered && place.sight_clearance > 0.0F && (flags & target_absent) == 0;
        Camera camera;
        camera.position = place.position;
        camera.orientation = orientation_of(state_.look);
        camera.vertical_fov = profile_.vertical_fov;
        camera.clearance = place.clearance;
        camera.flags = flags | (visible ? std::uint32_t{target_visible} : 0U);
        camera.objective = objective(profile_, player_, before, place);
        return camera;
    }

    [[nodiscard]] Moves moves(const Spot& spot, const Vec3f& position) const {
        Moves all;
        all.spot = player_.anchor + spot.offset - position;
        all.inertia = state_.velocity * dt_;
        all.safety = move_to_safety(space_, position, state_.slab);
        all.visibility = player_.move;
        return all;
    }

    [[nodiscard]] Look wanted_look() const {
        const Vec3f to_eye = player_.eye - state_.position;
        Look look = look_along(to_eye.norm() > at_the_eye * profile_.unit ? to_eye : player_.heading,
                               state_.look.yaw);
        look.pitch = std::clamp(look.pitch + profile_.framing_offset, -quarter_turn, quarter_turn);
        return look;
    }

    // A view that shows the player at the same place of the picture from another position.
    [[nodiscard]] Look moved_along(const Look& look, const Vec3f& from, const Vec3f& to) const {
        const Look old_way = look_along(player_.eye - from, look.yaw);
        const Look way = look_along(player_.eye - to, old_way.yaw);
        return {wrapped(look.yaw + way.yaw - old_way.yaw),
                std::clamp(look.pitch + way.pitch - old_way.pitch, -quarter_turn, quarter_turn)};
    }

    void turn() {
        const float share =
            profile_.look_smoothing > 0.0F ? 1.0F - std::exp(-dt_ / profile_.look_smoothing) : 1.0F;
        state_.look = turned(state_.look, wanted_look(), share, turn_limit_ * dt_);
    }

    // The eye is in no slab, and so far from the last free point on its way that this is no substitute.
    [[nodiscard]] bool out_of_reach() const {
        return !player_.covered && (player_.eye - player_.anchor).norm() > 0.5F * profile_.distance;
    }

    [[nodiscard]] Motion motion() const { return {state_.position, state_.velocity, dt_}; }
    [[nodiscard]] Motion standing() const { return {state_.position, Vec3f::Zero(), dt_}; }
    [[nodiscard]] float speed() const { return state_.velocity.norm(); }
    [[nodiscard]] Vec3f within_reach(const Vec3f& target) const {
        return within_step(state_.position, target, profile_.step_limit);
    }

    const freespace::Space space_;
    const MapProfile profile_;
    const float dt_;
    const Look look_before_;
    ShotState& state_;
    PlayerTrack& player_;
    Scratch& scratch_;
    const Window window_;
    const Crowd& crowd_;
    const double time_;
    float turn_limit_ = profile_.turn_limit;
};

}  // namespace

Camera step(const freespace::Space& space, const Profile& profile, Window window, double time,
            ShotState& state, Scratch& scratch, const Crowd& crowd) {
    const auto pose = pose_at(window, state.time, time);
    Step one(space, profile, time - state.time, state, scratch, window, crowd, time);
    state.time = time;
    return pose ? one.with_pose(*pose) : one.without_pose();
}

Camera step(const freespace::Space& space, const Profile& profile, const Pose* pose, double dt,
            ShotState& state, Scratch& scratch, const Crowd& crowd) {
    const double time = state.time + usable_frame(dt);
    state.recent.add(time, pose);
    Step one(space, profile, dt, state, scratch, state.recent.window(), crowd, time);
    state.time = time;
    return pose != nullptr && usable(*pose) ? one.with_pose(*pose) : one.without_pose();
}

bool go_on_from(const freespace::Space& space, const Profile& profile, const View& before, const View& now,
                double dt, ShotState& state) {
    const MapProfile on_map(profile, space.map().metadata().metres_per_unit);
    const auto place = look_up(space.at(state.time), on_map, state.player, now.position);
    if (!state.started || !place) return false;
    const Look look_before = look_along(before.orientation * Vec3f::UnitX(), state.look.yaw);
    state.position = place->position;
    state.slab = place->slab;
    state.velocity = (now.position - before.position) / usable_frame(dt);
    state.look = look_along(now.orientation * Vec3f::UnitX(), look_before.yaw);
    restart_plan(state.plan, {state.position, state.velocity, look_before, state.look}, state.player,
                 usable_frame(dt));
    return true;
}

}  // namespace camdir::camera
