#include "camera/planner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "camera/reach.hpp"
#include "camera/tuning.hpp"
#include "freespace/distance.hpp"
#include "freespace/slab.hpp"
#include "freespace/visibility.hpp"

namespace camdir::camera {
namespace {

constexpr double pi = std::numbers::pi;
constexpr float degree = radians_of_a_degree<float>;
constexpr double steepest = 80.0 * radians_of_a_degree<double>;

double stiffness(double tau, double step) {
    const double ratio = tau / step;
    return ratio * ratio * ratio * ratio;
}

float beam_radius_at(const freespace::Freespace& freespace, const MapProfile& profile, const Vec3f& eye) {
    const float clearance = freespace::distance_everywhere(freespace, eye).value;
    return std::max(0.0F, std::min(tuning.beam * profile.unit, 0.9F * clearance));
}

class Planning {
  public:
    Planning(const freespace::Freespace& freespace, const MapProfile& profile, PlanState& plan,
             PlanScratch& scratch)
        : freespace_(freespace), profile_(profile), plan_(plan), s_(scratch), future_(scratch.future) {}

    void run(Window window, double time, double step, double horizon) {
        foresee(freespace_, profile_, window, time, step, horizon,
                static_cast<float>(plan_.history[1].heading_yaw), s_.future);
        n_ = future_.count;
        step_ = step;
        ahead_ = static_cast<double>(future_.known) * step > 0.3;
        smooth_heading();
        smooth_eye();
        for (std::size_t i = 0; i < n_; ++i)
            s_.radius[i] = -1.0F;
        choose_directions();
        refine_path();
        if (ahead_) for (std::size_t i = 0; i < std::min<std::size_t>(knot_, n_); ++i) {
            const Vec3f f = direction_of(future_[i].view);
            if (angle_between((future_[i].eye.cast<double>() - s_.path[i]).cast<float>(), f) > 60 * degree) ++bad_path;
            ++all_path;
        }
        aim();
        store();
    }

  private:
    void smooth_heading() {
        const double dead = tuning.dead_zone * degree;
        const double tau = ahead_ ? tuning.heading_tau_ahead : tuning.heading_tau;
        std::fill_n(s_.weights.begin(), n_, 1.0);
        const int rounds = ahead_ ? tuning.reweightings : tuning.reweightings_causal;
        for (int round = 0;; ++round) {
            solve_angles(tau, [&](std::size_t i) { return double{future_[i].view.yaw}; }, yaw_before(),
                         s_.yaw);
            if (round == rounds) break;
            for (std::size_t i = 0; i < n_; ++i) {
                const double off = std::abs(s_.yaw[i] - future_[i].view.yaw);
                s_.weights[i] = off <= dead ? 0.1 : 0.1 + (off - dead) / off * 2.0;
            }
        }
        std::fill_n(s_.weights.begin(), n_, 1.0);
        solve_angles(tuning.pitch_tau, [&](std::size_t i) { return double{future_[i].view.pitch}; },
                     pitch_before(), s_.pitch);
    }
    std::array<double, 2> yaw_before() const {
        return {plan_.history[0].heading_yaw, plan_.history[1].heading_yaw};
    }
    std::array<double, 2> pitch_before() const {
        return {plan_.history[0].heading_pitch, plan_.history[1].heading_pitch};
    }
    template <class Goal>
    void solve_angles(double tau, const Goal& goal, const std::array<double, 2>& before,
                      std::array<double, Future::capacity>& out) {
        s_.smoother.factorise({s_.weights.data(), n_}, stiffness(tau, step_));
        for (std::size_t i = 0; i < n_; ++i)
            out[i] = s_.weights[i] * goal(i);
        s_.smoother.solve(before[0], before[1], std::span(out.data(), n_));
    }

    void smooth_eye() {
        std::fill_n(s_.weights.begin(), n_, 1.0);
        s_.smoother.factorise({s_.weights.data(), n_},
                              stiffness(ahead_ ? tuning.eye_tau_ahead : tuning.eye_tau, step_));
        for (std::size_t i = 0; i < n_; ++i)
            s_.eyes[i] = future_[i].eye.cast<double>();
        s_.smoother.solve(plan_.history[0].eye, plan_.history[1].eye, std::span(s_.eyes.data(), n_));
    }

    [[nodiscard]] Look behind(std::size_t i) const {
        const double pitch = std::clamp(-s_.pitch[i] + profile_.elevation, -steepest, steepest);
        return {static_cast<float>(s_.yaw[i] + pi), static_cast<float>(pitch)};
    }

    float radius(std::size_t i) {
        if (s_.radius[i] < 0.0F) s_.radius[i] = beam_radius_at(freespace_, profile_, future_[i].eye);
        return s_.radius[i];
    }
    // How far the beam from the eye of sample i is free along `direction`.
    float free_length(std::size_t i, const Vec3f& direction, float length) {
        const Vec3f& eye = future_[i].eye;
        const freespace::Sight beam = freespace::sight(freespace_, eye, eye + length * direction, radius(i));
        return beam.clear ? length : std::max(0.0F, beam.free_length - inside_beam * profile_.unit);
    }

    // Where the beam of sample i to its place on the path leaves the freespace, and which way it leaves.
    struct Exit {
        float free = 0.0F;  // length
        Vec3f normal = Vec3f::Zero();
    };
    std::optional<Exit> blocked(std::size_t i, const Vec3f& direction, float length) {
        const Vec3f& eye = future_[i].eye;
        const freespace::Sight beam = freespace::sight(freespace_, eye, eye + length * direction, radius(i));
        if (beam.clear) return std::nullopt;
        Exit exit{std::max(0.0F, beam.free_length - inside_beam * profile_.unit), direction};
        if (beam.triangle != freespace::none) {
            const Vec3f point = eye + beam.free_length * direction;
            freespace::SlabPoint best;
            freespace::improve_range(freespace_.mesh(), point, beam.triangle, 1, best);
            if (best.triangle != freespace::none) {
                const Vec3f out = point - freespace::ball_at(freespace_.mesh(), best).centre.cast<float>();
                if (out.norm() > 1e-3F) exit.normal = out.normalized();
            }
        }
        return exit;
    }

    void choose_directions() {
        knot_ = std::max<std::size_t>(
            1, static_cast<std::size_t>(std::lround((ahead_ ? tuning.knot_ahead : tuning.knot) / step_)));
        const std::size_t knots = std::min(Programme::knots, (n_ - 1) / knot_ + 1);
        const auto& directions = DirectionGrid::directions();
        const float wang = ahead_ ? tuning.wang_ahead : tuning.wang;
        const float lam = ahead_ ? tuning.lam_ahead : tuning.lam;
        const Vec3f camera = (plan_.history[1].position - plan_.history[1].eye).cast<float>();
        const float camera_length = camera.norm();
        for (std::size_t k = 0; k < knots; ++k) {
            const Vec3f straight = direction_of(behind(k * knot_));
            auto& costs = s_.direction_costs[k];
            for (std::size_t c = 0; c < DirectionGrid::size; ++c) {
                const float angle = std::acos(std::clamp(straight.dot(directions[c]), -1.0F, 1.0F));
                costs[c] = angle > tuning.cone * degree ? 2.0F * Programme::forbidden
                                                        : wang * (angle / (45.0F * degree)) * (angle / (45.0F * degree));
                if (k == 0 && camera_length > 1.0F * profile_.unit) {
                    const float turn = angle_between(directions[c], camera) / DirectionGrid::spacing;
                    costs[c] += lam * turn * turn;
                }
                if (tuning.good_weight > 0.0F && costs[c] < Programme::forbidden) {
                    const std::size_t middle = std::min(n_ - 1, k * knot_ + knot_ / 2);
                    for (std::size_t i = k * knot_; i < std::min(n_, (k + 1) * knot_); i += 2) { (void)middle;
                        const Look view = future_[i].view;
                        const float off = angle_between(-direction_of(view), directions[c]) / degree;
                        const float over = std::max(0.0F, off - tuning.good_angle) / 10.0F;
                        costs[c] += tuning.good_weight * std::min(2.0F, over * over);
                    }
                }
            }
        }
        ProgrammeCosts costs;
        costs.length = profile_.distance;
        costs.shortage = tuning.wd;
        costs.close = tuning.close_cost;
        costs.turn = lam;
        costs.stretch = ahead_ ? tuning.mu_ahead : tuning.mu;
        costs.start_length = std::min(camera_length, profile_.distance);
        const auto choices = s_.programme.solve(
            {s_.direction_costs.data(), knots}, costs, [&](std::size_t k, std::size_t c) {
                return free_length(k * knot_, DirectionGrid::directions()[c], profile_.distance);
            });
        if (choices.empty()) return head_on();
        set_targets(choices);
        if (ahead_) for (std::size_t i = 0; i < std::min<std::size_t>(knot_, n_); ++i) {
            const Vec3f f = direction_of(future_[i].view);
            if (angle_between((future_[i].eye.cast<double>() - s_.targets[i]).cast<float>(), f) > 60 * degree) ++bad_target;
            if (angle_between(-direction_of(behind(i)), f) > 60 * degree) ++bad_heading;
        }
    }

    // Every path turns faster than the programme can: straight behind, as far as that is free.
    void head_on() {
        for (std::size_t i = 0; i < n_; ++i) {
            const Vec3f direction = direction_of(behind(i));
            s_.lengths[i] = free_length(i, direction, profile_.distance);
            s_.targets[i] = s_.eyes[i] + s_.lengths[i] * direction.cast<double>();
        }
    }

    struct Spot {
        Look look;
        float length;
        bool snapped;
    };
    Spot spot_of(std::size_t k, const Programme::Choice& choice) {
        const Look straight = behind(k * knot_);
        const Vec3f direction = direction_of(straight);
        const float angle = angle_between(direction, DirectionGrid::directions()[choice.bin]);
        if (angle < tuning.snap_angle * degree) {
            const float length = free_length(k * knot_, direction, profile_.distance);
            if (length >= choice.length - tuning.snap_length * profile_.unit) return {straight, length, true};
        }
        return {DirectionGrid::look(choice.bin), choice.length, false};
    }
    void set_targets(std::span<const Programme::Choice> choices) {
        Spot a = spot_of(0, choices[0]);
        for (std::size_t k = 0; k < choices.size(); ++k) {
            const bool last = k + 1 == choices.size();
            const Spot b = last ? a : spot_of(k + 1, choices[k + 1]);
            const std::size_t end = last ? n_ : (k + 1) * knot_;
            for (std::size_t i = k * knot_; i < end; ++i) {
                const float share = static_cast<float>(i - k * knot_) / static_cast<float>(knot_);
                Look look = behind(i);
                if (!a.snapped || !b.snapped) {
                    look.yaw = a.look.yaw + share * wrapped(b.look.yaw - a.look.yaw);
                    look.pitch = a.look.pitch + share * (b.look.pitch - a.look.pitch);
                }
                const float length = last ? a.length : a.length + share * (b.length - a.length);
                s_.targets[i] = s_.eyes[i] + (length * direction_of(look)).cast<double>();
                s_.lengths[i] = length;
            }
            a = b;
        }
    }

    void solve_path() {
        const double tau = ahead_ ? tuning.pos_tau_ahead : tuning.pos_tau;
        s_.smoother.factorise({s_.weights.data(), n_}, stiffness(tau, step_));
        for (std::size_t i = 0; i < n_; ++i)
            s_.path[i] = s_.weights[i] * s_.targets[i];
        s_.smoother.solve(plan_.history[0].position, plan_.history[1].position, std::span(s_.path.data(), n_));
    }
    void raise(std::size_t i, double factor) {
        const auto reach = static_cast<std::size_t>(tuning.reach);
        for (std::size_t k = i >= reach ? i - reach : 0; k <= std::min(n_ - 1, i + reach); ++k)
            s_.weights[k] = std::min<double>(tuning.boost_limit, s_.weights[k] * factor);
    }
    void refine_path() {
        std::fill_n(s_.weights.begin(), n_, 1.0);
        const int rounds = ahead_ ? tuning.rounds_ahead : tuning.rounds;
        const auto stride = static_cast<std::size_t>(tuning.stride);
        for (int round = 0;; ++round) {
            solve_path();
            if (round == rounds) break;
            bool changed = false;
            for (std::size_t i = 0; i < n_; i += stride) {
                const Vec3f way = s_.path[i].cast<float>() - future_[i].eye;
                const float length = way.norm();
                if (length < profile_.unit) continue;
                const Vec3f direction = way / length;
                if (const auto exit = blocked(i, direction, length)) {
                    changed = true;
                    Vec3f offset = exit->free * direction;
                    if (tuning.x1 > 0.0F) {
                        const float depth = exit->normal.dot(way - offset);
                        if (depth > tuning.x1 * (length - exit->free)) offset = way - depth * exit->normal;
                    }
                    for (std::size_t k = i; k < std::min(n_, i + stride); ++k) {
                        s_.targets[k] = (future_[k].eye + offset).cast<double>();
                        s_.lengths[k] = offset.norm();
                    }
                    raise(i, tuning.boost);
                }
            }
            if (tuning.x2 > 0.0F && round < tuning.radial_rounds) changed = keep_distance() || changed;
            if (tuning.hinge_boost > 0.0F) changed = keep_good() || changed;
            if (!changed) break;
        }
    }
    // Moves the goals out where the path cuts a corner, and in where it overshoots: at the same distance from
    // the player, it turns as slowly as before.
    bool keep_distance() {
        for (std::size_t i = 0; i < n_; ++i) {
            const Vec3d way = s_.path[i] - s_.eyes[i];
            const double length = way.norm();
            if (length < 1.0) continue;
            s_.targets[i] += tuning.x2 * (s_.lengths[i] - length) / length * way;
        }
        return true;
    }
    // Raises the weights where the smoothed path is off the player's view or distance though its goal is not.
    bool keep_good() {
        bool changed = false;
        for (std::size_t i = 0; i < n_; ++i) {
            const Vec3f ahead = direction_of(future_[i].view);
            const Vec3f eye = future_[i].eye;
            const auto badness = [&](const Vec3d& place) {
                const Vec3f way = eye - place.cast<float>();
                const float angle = angle_between(way, ahead) / degree - tuning.hinge_angle;
                const float off =
                    std::abs(way.norm() - profile_.distance) / profile_.unit - tuning.hinge_dist;
                return std::max(0.0F, angle) + std::max(0.0F, off);
            };
            const float now = badness(s_.path[i]);
            if (now > 0.0F && badness(s_.targets[i]) < now) {
                s_.weights[i] = std::min<double>(tuning.boost_limit, s_.weights[i] * tuning.hinge_boost);
                changed = true;
            }
        }
        return changed;
    }

    void aim() {
        const double tau = ahead_ ? tuning.look_tau_ahead : tuning.look_tau;
        double yaw = plan_.history[1].look_yaw;
        for (std::size_t i = 0; i < n_; ++i) {
            const Vec3f way = (s_.eyes[i] - s_.path[i]).cast<float>();
            Look look = look_along(way, static_cast<float>(yaw));
            yaw += wrapped(look.yaw - static_cast<float>(yaw));
            look.pitch = std::clamp(look.pitch + profile_.framing_offset, -1.5F, 1.5F);
            s_.yaw2[i] = yaw;
            s_.pitch2[i] = look.pitch;
            const double level = std::cos(look.pitch);
            s_.weights[i] = std::max(0.02, level * level);
        }
        smooth_look(s_.yaw2, {plan_.history[0].look_yaw, plan_.history[1].look_yaw}, tau);
        std::fill_n(s_.weights.begin(), n_, 1.0);
        smooth_look(s_.pitch2, {plan_.history[0].look_pitch, plan_.history[1].look_pitch}, tau);
    }
    // With a dead zone: small deviations are nearly free.
    void smooth_look(std::array<double, Future::capacity>& values, const std::array<double, 2>& before,
                     double tau) {
        const double dead = tuning.look_dead * degree;
        std::copy_n(s_.weights.begin(), n_, s_.base.begin());
        std::copy_n(values.begin(), n_, s_.goals.begin());
        for (int round = 0;; ++round) {
            s_.smoother.factorise({s_.weights.data(), n_}, stiffness(tau, step_));
            for (std::size_t i = 0; i < n_; ++i)
                values[i] = s_.goals[i] * s_.weights[i];
            s_.smoother.solve(before[0], before[1], std::span(values.data(), n_));
            if (round == tuning.look_rounds) break;
            for (std::size_t i = 0; i < n_; ++i) {
                const double off = std::abs(values[i] - s_.goals[i]);
                s_.weights[i] = s_.base[i] * (off <= dead ? 0.1 : 0.1 + (off - dead) / off * tuning.x3);
            }
        }
    }

    void store() {
        const std::size_t keep = ahead_ ? std::max<std::size_t>(knot_ * static_cast<std::size_t>(tuning.replan_ahead) / 6, 1)
                                        : static_cast<std::size_t>(tuning.replan);
        plan_.count = std::min({keep, n_, PlanState::capacity});
        plan_.next = 0;
        plan_.step = step_;
        for (std::size_t i = 0; i < plan_.count; ++i)
            plan_.ahead[i] = {s_.path[i], s_.eyes[i], s_.yaw[i], s_.pitch[i], s_.yaw2[i], s_.pitch2[i]};
    }

    const freespace::Freespace& freespace_;
    const MapProfile& profile_;
    PlanState& plan_;
    PlanScratch& s_;
    const Future& future_;
    std::size_t n_ = 0;
    std::size_t knot_ = 1;
    double step_ = 0.0;
    bool ahead_ = false;
};

void wrap_history(PlanState& plan) {
    const auto wrap = [&](double PlannedSample::*angle) {
        const double turns = std::round(plan.history[1].*angle / (2.0 * pi)) * 2.0 * pi;
        for (PlannedSample& sample : plan.history)
            sample.*angle -= turns;
    };
    wrap(&PlannedSample::heading_yaw);
    wrap(&PlannedSample::look_yaw);
}

// The sample before the last, as it would have been with another time step.
void stretch_history(PlanState& plan, double dt) {
    if (plan.step > 0.0 && std::abs(dt - plan.step) > 1e-3 * dt) {
        const double ratio = dt / plan.step;
        PlannedSample& a = plan.history[0];
        const PlannedSample& b = plan.history[1];
        a.position = b.position + ratio * (a.position - b.position);
        a.eye = b.eye + ratio * (a.eye - b.eye);
        a.heading_yaw = b.heading_yaw + ratio * (a.heading_yaw - b.heading_yaw);
        a.heading_pitch = b.heading_pitch + ratio * (a.heading_pitch - b.heading_pitch);
        a.look_yaw = b.look_yaw + ratio * (a.look_yaw - b.look_yaw);
        a.look_pitch = b.look_pitch + ratio * (a.look_pitch - b.look_pitch);
        plan.next = plan.count;
    }
    plan.step = dt;
}

}  // namespace

void restart(PlanState& plan, const Vec3f& position, const Look& look, const PlayerTrack& track, double dt) {
    const Look heading = look_along(track.heading, 0.0F);
    PlannedSample& now = plan.history[1];
    now.position = position.cast<double>();
    now.eye = track.anchor.cast<double>();
    now.heading_yaw = heading.yaw;
    now.heading_pitch = heading.pitch;
    now.look_yaw = look.yaw;
    now.look_pitch = look.pitch;
    plan.history[0] = now;
    plan.history[0].position -= track.velocity.cast<double>() * dt;
    plan.history[0].eye -= track.velocity.cast<double>() * dt;
    plan.count = plan.next = 0;
    plan.step = dt;
}

void deviate(PlanState& plan, const Vec3f& position, const Vec3f& velocity, const Look& look) {
    PlannedSample& now = plan.history[1];
    now.position = position.cast<double>();
    plan.history[0].position = now.position - velocity.cast<double>() * plan.step;
    const double turn = wrapped(static_cast<float>(look.yaw - now.look_yaw));
    now.look_yaw += turn;
    now.look_pitch = look.pitch;
    plan.count = plan.next = 0;
}

const PlannedSample& next_sample(const freespace::Freespace& freespace, const MapProfile& profile,
                                 Window window, double time, double dt, double horizon, PlanState& plan,
                                 PlanScratch& scratch) {
    stretch_history(plan, dt);
    if (plan.next >= plan.count) {
        wrap_history(plan);
        Planning(freespace, profile, plan, scratch).run(window, time, dt, horizon);
    }
    plan.history[0] = plan.history[1];
    plan.history[1] = plan.ahead[plan.next++];
    return plan.history[1];
}

}  // namespace camdir::camera
