#include "camera/candidates.hpp"

#include <algorithm>
#include <cmath>

#include "base/float4.hpp"
#include "camera/float4_angles.hpp"

namespace camdir::camera {
namespace {

constexpr float turn_cost = 0.25F;
constexpr float turn_cost_ahead = 0.6F;
constexpr float stretch_cost = 0.1F;
constexpr float stretch_cost_ahead = 0.5F;
constexpr float snap_angle =
    13.0F * radians_of_a_degree<float>;  // of straight behind from the direction beside it
constexpr float snap_length = 8.0F;      // units that it may be shorter
constexpr float body_cost = 5.0F;
constexpr double bodies_ahead = 1.0;     // s: later the plan is another
constexpr float closing_speed = 600.0F;  // units/s, of two who run towards each other
// Vantages are kept for so long, s, while the player's turns leave each within so much of where it was
// foreseen.
constexpr double kept_for = 0.1;
constexpr float near_foreseen = 15.0F * radians_of_a_degree<float>;

std::size_t knots_of(const Plan& plan) {
    return std::min(Programme::knots, (plan.count() - 1) / plan.knot_spacing + 1);
}

// Off straight behind sample i.
Look look_from_behind(const MapProfile& profile, const Plan& plan, std::size_t i, const Look& off) {
    const Look behind = plan.behind(i, profile.elevation);
    return {behind.yaw + off.yaw,
            std::clamp(behind.pitch + off.pitch, -steepest_arm<float>, steepest_arm<float>)};
}

class Choosing {
  public:
    Choosing(const MapProfile& profile, const History& history, Beams& beams, const Crowd& crowd,
             const Plan& plan, CandidateScratch& scratch)
        : profile_(profile), beams_(beams), crowd_(crowd), plan_(plan), scratch_(scratch) {
        camera_ = (history[1].position - history[1].eye).cast<float>();
        turn_cost_ = (plan.ahead ? turn_cost_ahead : turn_cost) * profile.weight_inertia_angle;
    }

    void run(Vantages& vantages) {
        const std::size_t knots = knots_of(plan_);
        auto& direction_costs = scratch_.direction_costs;
        for (std::size_t knot = 0; knot < knots; ++knot)
            weigh_directions(profile_, plan_, knot * plan_.knot_spacing, direction_costs[knot]);
        look_past_bodies(knots);
        if (camera_.norm() > profile_.unit) add_turn(camera_.normalized(), turn_cost_, direction_costs[0]);
        const auto length = [this](std::size_t knot, std::size_t bin) {
            return beams_.free_length(knot * plan_.knot_spacing, bin);
        };
        const auto choices = scratch_.programme.solve({direction_costs.data(), knots}, costs(), length);
        for (std::size_t knot = 0; knot < choices.size(); ++knot)
            vantages.at_knots[knot] = vantage_of(knot, choices[knot]);
        vantages.count = choices.size();
        vantages.knot_spacing = plan_.knot_spacing;
        vantages.age = 0;
    }

  private:
    void look_past_bodies(std::size_t knots) {
        const double knot_time = static_cast<double>(plan_.knot_spacing) * plan_.future.step;
        const double ahead = std::min(bodies_ahead, static_cast<double>(knots - 1) * knot_time);
        const float range = profile_.distance + closing_speed * profile_.unit * static_cast<float>(ahead);
        Bystanders bystanders(crowd_, plan_.future[0].eye, plan_.future.start, range);
        if (bystanders.empty()) return;
        for (std::size_t knot = 0; knot < knots; ++knot) {
            const double later = static_cast<double>(knot) * knot_time;
            if (later > ahead) break;
            const Vec3f& eye = plan_.future[knot * plan_.knot_spacing].eye;
            std::array<Vec3f, Bystanders::capacity> offsets;
            const auto others = bystanders.eyes_at(plan_.future.start + later);
            for (std::size_t i = 0; i < others.size(); ++i)
                offsets[i] = others[i] - eye;
            add_bodies(profile_, std::span(offsets).first(others.size()),
                       body_cost * profile_.weight_visibility, scratch_.direction_costs[knot]);
        }
    }

    [[nodiscard]] ProgrammeCosts costs() const {
        ProgrammeCosts costs;
        costs.length = profile_.distance;
        costs.shortage *= profile_.weight_distance;
        costs.close *= profile_.weight_distance;
        costs.turn = turn_cost_;
        costs.stretch = (plan_.ahead ? stretch_cost_ahead : stretch_cost) * profile_.weight_inertia_distance;
        costs.start_length = std::min(camera_.norm(), profile_.distance);
        return costs;
    }

    [[nodiscard]] Vantage vantage_of(std::size_t knot, const Programme::Choice& choice) {
        const std::size_t i = knot * plan_.knot_spacing;
        const Look behind = plan_.behind(i, profile_.elevation);
        const Vec3f direction = direction_of(behind);
        if (angle_between(direction, directions_[choice.bin]) < snap_angle) {
            const float length = beams_.free_length(i, direction, profile_.distance);
            if (length >= choice.length - snap_length * profile_.unit) return {{}, length, direction};
        }
        const Look look = DirectionGrid::look(choice.bin);
        return {{wrapped(look.yaw - behind.yaw), look.pitch - behind.pitch},
                choice.length,
                directions_[choice.bin]};
    }

    const std::array<Vec3f, DirectionGrid::size>& directions_ = DirectionGrid::directions();
    const MapProfile& profile_;
    Beams& beams_;
    const Crowd& crowd_;
    const Plan& plan_;
    CandidateScratch& scratch_;
    Vec3f camera_;  // from the eye
    float turn_cost_;
};

bool still_hold(const MapProfile& profile, const Plan& plan, const Vantages& vantages) {
    if (vantages.count == 0 || vantages.age >= plan.samples_in(kept_for)) return false;
    if (plan.ahead || vantages.knot_spacing != plan.knot_spacing || vantages.count != knots_of(plan))
        return false;
    for (std::size_t knot = 0; knot < vantages.count; ++knot) {
        if (knot * plan.knot_spacing < vantages.age) continue;  // it is past
        const Vantage& vantage = vantages.at_knots[knot];
        const std::size_t i = knot * plan.knot_spacing - vantages.age;
        const Vec3f direction = direction_of(look_from_behind(profile, plan, i, vantage.off_behind));
        if (angle_between(direction, vantage.foreseen) > near_foreseen) return false;
    }
    return true;
}

void set_goal(std::size_t i, const Vec3f& direction, float length, Plan& plan) {
    plan.length[i] = length;
    plan.goal[i] = plan.eye[i] + plan.length[i] * direction.cast<double>();
}

struct Arm {
    Look look;
    float length;
};

// From the eye of sample i, between the vantages of two knots.
Arm arm_at(const MapProfile& profile, const Vantages& vantages, std::size_t i, const Plan& plan) {
    const std::size_t last = vantages.count - 1;
    const std::size_t knot = (vantages.age + i) / plan.knot_spacing;
    const Vantage& from = vantages.at_knots[std::min(knot, last)];
    const Vantage& to = vantages.at_knots[std::min(knot + 1, last)];
    const float share =
        static_cast<float>((vantages.age + i) % plan.knot_spacing) / static_cast<float>(plan.knot_spacing);
    const Look off{from.off_behind.yaw + share * wrapped(to.off_behind.yaw - from.off_behind.yaw),
                   from.off_behind.pitch + share * (to.off_behind.pitch - from.off_behind.pitch)};
    return {look_from_behind(profile, plan, i, off), from.length + share * (to.length - from.length)};
}

}  // namespace

const std::array<Vec3f, DirectionGrid::size>& DirectionGrid::directions() {
    static const std::array<Vec3f, size> all = [] {
        std::array<Vec3f, size> list;
        for (std::size_t bin = 0; bin < size; ++bin)
            list[bin] = direction_of(look(bin));
        return list;
    }();
    return all;
}

void choose_vantages(const MapProfile& profile, const History& history, Beams& beams, const Crowd& crowd,
                     const Plan& plan, CandidateScratch& scratch, Vantages& vantages) {
    if (!still_hold(profile, plan, vantages))
        Choosing(profile, history, beams, crowd, plan, scratch).run(vantages);
}

void set_goals(const MapProfile& profile, const Vantages& vantages, Beams& beams, Plan& plan) {
    if (vantages.count == 0) {
        for (std::size_t i = 0; i < plan.count(); ++i) {
            const Vec3f direction = direction_of(plan.behind(i, profile.elevation));
            set_goal(i, direction, beams.free_length(i, direction, profile.distance), plan);
        }
        return;
    }
    for (std::size_t i = 0; i < plan.count(); i += lane_count) {
        std::array<Arm, lane_count> four;
        for (std::size_t k = 0; k < four.size(); ++k)
            four[k] = arm_at(profile, vantages, std::min(i + k, plan.count() - 1), plan);
        const Directions directions = directions_of(
            Float4{four[0].look.yaw, four[1].look.yaw, four[2].look.yaw, four[3].look.yaw},
            Float4{four[0].look.pitch, four[1].look.pitch, four[2].look.pitch, four[3].look.pitch});
        for (std::size_t k = 0; k < std::min(four.size(), plan.count() - i); ++k)
            set_goal(i + k, {directions.x[k], directions.y[k], directions.z[k]}, four[k].length, plan);
    }
}

}  // namespace camdir::camera
