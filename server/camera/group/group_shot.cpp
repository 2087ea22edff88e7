#include "camera/group/group_shot.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "camera/cut.hpp"
#include "camera/evade.hpp"
#include "camera/group/framing.hpp"
#include "camera/group/glide.hpp"
#include "camera/group/viewpoint.hpp"

namespace camdir::camera {
namespace {

constexpr float choice_interval = 0.1F;           // s
constexpr float hurried_choice_interval = 0.03F;  // s: while somebody is not shown
constexpr float share_by_a_recording = 0.5F;      // of these: what shows all at its instants is remembered
constexpr std::uint32_t phases = 8;
constexpr float a_moment = 0.2F;  // s: a cut to some, or the first, comes no sooner before they are shown
constexpr float worth_a_move = 0.01F;  // s more that everyone is shown
constexpr float patience = 0.6F;       // s that somebody is hidden before a cut to others than everyone
constexpr float shortest_partial_shot = 2.5F;       // s: likewise
constexpr float patience_while_empty = 0.3F;        // s: likewise, where nobody is shown
constexpr float shortest_empty_shot = 1.5F;         // s: likewise
constexpr float known_patience_while_empty = 0.1F;  // s: likewise, where the future is known

constexpr float zone_share = 0.55F;  // of the picture: the dead zone
constexpr float kept_ahead = 0.4F;   // s, for which they are kept in it
constexpr float soon = 0.3F;         // s: for those who are seen by then the look waits
constexpr float pan_time = 0.09F;    // s, at the least: time constant of the rotation
constexpr float pan_lag = 0.2F;      // s: of the rotation
constexpr float kept_share = 0.89F;  // of the picture: within what counts as shown, in spite of rounding
constexpr float fastest_correction = 2.8F;     // rad/s: of the look, where somebody would leave that
constexpr float fastest_partial_turn = 3.49F;  // rad/s: for some of the members, who may pass close by

// Without the member who matters least; `set` is not empty.
MemberSet without_the_last(MemberSet set) {
    return set & (set - 1);
}

// One step of one shot.
class GroupStep {
  public:
    GroupStep(const freespace::Space& space, const Profile& profile, const Members& members, float dt,
              GroupState& state, Outlook& outlook)
        : space_(space),
          profile_(profile, space.map().metadata().metres_per_unit),
          members_(members),
          dt_(dt),
          state_(state),
          outlook_(outlook) {}

    Camera with_members() {
        state_.since_cut += dt_;
        state_.until_choice -= dt_;
        bool cuts = !state_.started;
        if (!state_.started) {
            begin();
            state_.until_choice += choice_interval * static_cast<float>(state_.phase % phases) / phases;
        } else {
            cuts = is_threatened() ? make_way() : (glide(), false);
            turn();
        }
        const bool was_complete = state_.incomplete_for == 0.0F;
        judge();
        if (!cuts && members_.is_recorded && was_complete && shown_ != members_.now().living)
            state_.until_choice = 0.0F;
        if (!cuts && state_.until_choice <= 0.0F && members_.now().living != 0 && choose()) {
            cuts = true;
            judge();
        }
        state_.side = side_of(members_.now(), state_.position);
        return frame(flags_ | (cuts ? std::uint32_t{cut} : 0U));
    }

    Camera without_members() {
        if (state_.started || state_.waiting) {
            const bool cuts = is_threatened() && make_way();
            return frame(target_absent | held | (cuts ? std::uint32_t{cut} : 0U));
        }
        state_.waiting = true;
        if (!space_.map().spawn_points().empty()) {
            const freespace::SpawnPoint& spawn = space_.map().spawn_points().front();
            state_.position = spawn.eye;
            state_.look.yaw = spawn.yaw;
        }
        return frame(target_absent | held | cut);
    }

  private:
    // Whether everyone is shown, from where the camera is.
    void judge() {
        const Members::Instant& now = members_.now();
        shown_ = 0;
        for (std::size_t member = 0; member < max_members; ++member) {
            const Eyes eye(now, only(member));
            const auto extent = extent_of(state_.position, state_.look, eye.span());
            if (extent && extent->within(safe_area(profile_))) shown_ |= only(member);
        }
        shown_ &= seen_from(space_, state_.position, now);
        const bool complete = shown_ == now.living;
        state_.incomplete_for = complete ? 0.0F : state_.incomplete_for + dt_;
        state_.empty_for = shown_ != 0 || now.living == 0 ? 0.0F : state_.empty_for + dt_;
        flags_ = now.living == 0 ? std::uint32_t{held}
                 : complete      ? std::uint32_t{target_visible}
                                 : std::uint32_t{searching} | (shown_ == 0 ? std::uint32_t{held} : 0U);
    }

    // True when it cuts.
    bool choose() {
        const MemberSet all = members_.soon_living();
        const bool complete = shown_ == members_.now().living;
        state_.until_choice = (complete ? choice_interval : hurried_choice_interval) *
                              (members_.is_recorded ? share_by_a_recording : 1.0F);
        const Standpoint from = standpoint();
        const ViewpointSearch search(space_, profile_, members_, all, from, outlook_);
        const float staying = search.worth_of_going_on();
        const auto near = search.glide();
        const bool glides = near && near->worth > staying + worth_a_move;
        if (from.cut_in <= 0.0F) {
            const auto far = search.cut(shortest_group_shot);
            if (far && (far->worth > (glides ? near->worth : staying) + worth_a_move ||
                        (!complete && !glides && search.is_due(*far)))) {
                cut_to(*far);
                return true;
            }
        }
        if (glides) glide_to(*near);
        if (complete || glides) return false;
        return show_those_who_matter_more(search);
    }

    // Where not everyone can be shown, unless that keeps the camera from showing everyone soon, or those are
    // seen again by waiting.
    bool show_those_who_matter_more(const ViewpointSearch& everyone) {
        if (!has_waited_enough()) return false;
        for (MemberSet set = next_choice(members_.now().living); set > shown_; set = next_choice(set)) {
            const ViewpointSearch some(space_, profile_, members_, set, standpoint(), outlook_);
            const auto found = some.cut(a_moment);
            if (!found) continue;
            const float waiting = some.worth_without_a_cut();
            if (found->worth > waiting + worth_a_move) {
                if (everyone.loses_by_cutting_to(found->position)) return false;
                cut_to(*found);
                return true;
            }
            if (waiting > worth_a_move) return false;
        }
        return false;
    }

    // Fewer of those who matter more; when none of them can be shown, each of the others.
    [[nodiscard]] MemberSet next_choice(MemberSet set) const {
        const MemberSet fewer = without_the_last(set);
        return fewer != 0 ? fewer : std::bit_floor(members_.now().living & (set - 1));
    }

    // Less in an empty picture, and there less where the future is known.
    [[nodiscard]] bool has_waited_enough() const {
        if (shown_ != 0)
            return state_.since_cut >= shortest_partial_shot && state_.incomplete_for >= patience;
        return members_.is_recorded
                   ? state_.since_cut >= shortest_group_shot && state_.empty_for >= known_patience_while_empty
                   : state_.since_cut >= shortest_empty_shot && state_.empty_for >= patience_while_empty;
    }

    [[nodiscard]] Standpoint standpoint() const {
        return {state_.position, state_.side, std::max(shortest_group_shot - state_.since_cut, 0.0F),
                state_.velocity, state_.goal};
    }

    void begin() {
        state_.started = true;
        for (MemberSet set = members_.now().living; set != 0; set = without_the_last(set))
            if (const auto found =
                    ViewpointSearch(space_, profile_, members_, set, {}, outlook_).cut(a_moment))
                return cut_to(*found);
        land_at_the_most_important();
    }

    // Where no lookout sees anybody.
    void land_at_the_most_important() {
        const Members::Instant& now = members_.now();
        const MemberSet some = now.living != 0 ? now.living : now.present;
        const std::size_t first = max_members - static_cast<std::size_t>(std::bit_width(some));
        const Vec3f& eye = now.eyes[first];
        const Vec3f place = landing_near(eye);
        cut_to({place, look_along(eye - place, state_.look.yaw), now.living & only(first), 0.0F});
    }

    [[nodiscard]] Vec3f landing_near(const Vec3f& point) const {
        Pose pose;
        pose.eye = point;
        PlayerTrack track;
        restart(space_, profile_, pose, track);
        return landing(space_, profile_, track).position;
    }

    [[nodiscard]] bool is_threatened() const {
        return camera::is_threatened(space_, state_.position, gliding_clearance());
    }

    // For a mover. True when it cuts.
    bool make_way() {
        const auto place = evade(space_, state_.position, gliding_clearance(), profile_.step_limit);
        if (!place && members_.now().present != 0) {
            begin();
            return true;
        }
        state_.position = state_.goal = place ? *place : landing_near(state_.position);
        state_.velocity.setZero();
        return !place;
    }

    void cut_to(const Viewpoint& viewpoint) {
        state_.position = state_.goal = viewpoint.position;
        state_.velocity = Vec3f::Zero();
        state_.look = viewpoint.look;
        state_.look_rate = {};
        state_.framed = viewpoint.shown;
        state_.since_cut = 0.0F;
        state_.incomplete_for = 0.0F;
        state_.empty_for = 0.0F;
        state_.until_choice = choice_interval;
    }

    void glide_to(const Viewpoint& viewpoint) {
        state_.goal = viewpoint.position;
        state_.framed = viewpoint.shown;
    }

    // Each step is free, by itself or on the straight way.
    void glide() {
        const Glide glide{state_.position, state_.velocity, state_.goal};
        if (glide.rests(profile_.unit)) {
            state_.velocity.setZero();
            return;
        }
        const Vec3f velocity = glide.velocity_after(dt_, profile_.unit);
        if (move_by(velocity)) return;
        const Vec3f way = (state_.goal - state_.position).normalized();
        const Vec3f straight = way * std::max(velocity.dot(way), 0.0F);
        if (move_by(straight)) return;
        state_.velocity.setZero();
        state_.goal = state_.position;
    }

    bool move_by(const Vec3f& velocity) {
        const Vec3f next = state_.position + velocity * dt_;
        const float clearance = gliding_clearance();
        if (!freespace::sight(space_.map(), state_.position, next, clearance).clear ||
            !space_.lets_pass(state_.position, next) || room_soon(space_, next, clearance) < clearance)
            return false;
        state_.position = next;
        state_.velocity = velocity;
        return true;
    }

    // The members that are to stay in the picture: those that the viewpoint was chosen for, and whoever else
    // is seen and finds room; of those who find no room together, while they are not all seen soon, who is
    // seen.
    [[nodiscard]] MemberSet wanted_in_picture(MemberSet seen) const {
        const Members::Instant& now = members_.now();
        if (seen == 0) return 0;
        const MemberSet framed = state_.framed & now.living;
        if (fit_one_picture(framed | seen)) return framed | seen;
        if (framed != 0 && shows_soon(framed)) return framed;
        MemberSet wanted = fit_one_picture(seen) || (framed & seen) == 0 ? seen : framed & seen;
        while (!fit_one_picture(wanted) && without_the_last(wanted) != 0)
            wanted = without_the_last(wanted);
        return wanted;
    }

    [[nodiscard]] bool shows_soon(MemberSet set) const {
        for (std::size_t i = 1; i < members_.until(soon); ++i) {
            const freespace::Space then = space_.at(space_.time() + static_cast<double>(members_.ahead[i]));
            if (fits_one_picture(state_.position, Eyes(members_.at[i], set).span(), safe_area(profile_)) &&
                (seen_from(then, state_.position, members_.at[i]) & set) == set)
                return true;
        }
        return false;
    }

    [[nodiscard]] bool fit_one_picture(MemberSet set) const {
        return fits_one_picture(state_.position, Eyes(members_.now(), set).span(), safe_area(profile_));
    }

    // Towards the look that keeps them in the dead zone soon, above all when it will be reached; critically
    // damped, but as fast as keeps them in the picture now.
    void turn() {
        const MemberSet seen = seen_from(space_, state_.position, members_.now());
        const MemberSet wanted = wanted_in_picture(seen);
        const float fastest = (wanted & seen) == members_.now().living
                                  ? profile_.turn_limit
                                  : std::min(profile_.turn_limit, fastest_partial_turn);
        Look look = state_.look;
        const std::size_t nearest = members_.until(pan_lag) - 1;
        const PictureShape zone = PictureShape::of(profile_.vertical_fov, zone_share);
        for (std::size_t i = members_.until(kept_ahead); i-- > nearest;)
            look = look_within(state_.position, look, Eyes(members_.at[i], wanted).span(), zone);
        if (members_.is_recorded)  // who jumps soon is still here
            look =
                look_within(state_.position, look, Eyes(members_.now(), wanted).span(), safe_area(profile_));
        const float rate = 1.0F / std::max(pan_time, profile_.look_smoothing);
        const auto accelerate = [&](float& speed, float way) {
            // Implicit: stable for every frame.
            speed = (speed + rate * rate * way * dt_) / (1.0F + 2.0F * rate * dt_ + rate * rate * dt_ * dt_);
            speed = std::clamp(speed, -fastest, fastest);
        };
        accelerate(state_.look_rate.yaw, wrapped(look.yaw - state_.look.yaw));
        accelerate(state_.look_rate.pitch, look.pitch - state_.look.pitch);
        const Look next{state_.look.yaw + state_.look_rate.yaw * dt_,
                        state_.look.pitch + state_.look_rate.pitch * dt_};
        const PictureShape kept_area = PictureShape::of(profile_.vertical_fov, kept_share);
        const Look kept = look_within(state_.position, next, Eyes(members_.now(), wanted).span(), kept_area);
        const Look corrected = turned(next, kept, 1.0F, fastest_correction * dt_);
        state_.look = turned(state_.look, corrected, 1.0F, fastest * dt_);
    }

    [[nodiscard]] float gliding_clearance() const { return 0.5F * profile_.minimum_clearance; }

    [[nodiscard]] Camera frame(std::uint32_t flags) const {
        Camera camera;
        camera.position = state_.position;
        camera.orientation = orientation_of(state_.look);
        camera.vertical_fov = profile_.vertical_fov;
        camera.clearance = std::max(freespace::distance(space_, state_.position).value, 0.0F);
        camera.flags = flags;
        return camera;
    }

    const freespace::Space space_;
    const MapProfile profile_;
    const Members& members_;
    float dt_;
    GroupState& state_;
    Outlook& outlook_;
    MemberSet shown_ = 0;
    std::uint32_t flags_ = 0;
};

}  // namespace

Camera step(const freespace::Space& space, const Profile& profile, std::span<const Window> members,
            double time, GroupState& state, Outlook& outlook) {
    assert(members.size() <= max_members);
    const freespace::Space now = space.in_step(state.time, time);
    const Members known = members_at(now, members, time);
    GroupStep one(now, profile, known, usable_frame(time - state.time), state, outlook);
    state.time = time;
    return known.now().present != 0 ? one.with_members() : one.without_members();
}

bool go_on_from(const freespace::Space& space, const View& before, const View& now, double dt,
                GroupState& state) {
    if (!state.started || !freespace::distance(space.at(state.time), now.position).covered()) return false;
    const float frame = usable_frame(dt);
    const Look look_before = look_along(before.orientation * Vec3f::UnitX(), state.look.yaw);
    state.look = look_along(now.orientation * Vec3f::UnitX(), look_before.yaw);
    state.look_rate = {wrapped(state.look.yaw - look_before.yaw) / frame,
                       (state.look.pitch - look_before.pitch) / frame};
    state.position = state.goal = now.position;
    state.velocity = (now.position - before.position) / frame;
    return true;
}

}  // namespace camdir::camera
