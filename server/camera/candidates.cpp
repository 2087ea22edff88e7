#include "camera/candidates.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::camera {
namespace {

constexpr float turn_cost = 0.25F;
constexpr float turn_cost_ahead = 0.3F;
constexpr float stretch_cost = 0.1F;
constexpr float stretch_cost_ahead = 0.5F;
constexpr float snap_angle =
    13.0F * radians_of_a_degree<float>;  // of straight behind from the direction beside it
constexpr float snap_length = 8.0F;      // units that it may be shorter

class Choosing {
  public:
    Choosing(const MapProfile& profile, const History& history, Beams& beams, Plan& plan,
             CandidateScratch& scratch)
        : profile_(profile), beams_(beams), plan_(plan), scratch_(scratch) {
        camera_ = (history[1].position - history[1].eye).cast<float>();
        turn_cost_ = (plan.ahead ? turn_cost_ahead : turn_cost) * profile.weight_inertia_angle;
    }

    void run() {
        const std::size_t knots = std::min(Programme::knots, (plan_.count() - 1) / plan_.knot_spacing + 1);
        auto& direction_costs = scratch_.direction_costs;
        for (std::size_t knot = 0; knot < knots; ++knot)
            weigh_directions(profile_, plan_, knot * plan_.knot_spacing, direction_costs[knot]);
        if (camera_.norm() > profile_.unit) add_turn(camera_.normalized(), turn_cost_, direction_costs[0]);
        const auto length = [this](std::size_t knot, std::size_t bin) {
            return beams_.free_length(knot * plan_.knot_spacing, bin);
        };
        const auto choices = scratch_.programme.solve({direction_costs.data(), knots}, costs(), length);
        if (choices.empty())
            stay_behind();
        else
            set_goals(choices);
    }

  private:
    struct Spot {
        Look look;  // from the eye
        float length;
        bool behind;
    };

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

    // Every path turns faster than the programme can.
    void stay_behind() {
        for (std::size_t i = 0; i < plan_.count(); ++i) {
            const Vec3f direction = direction_of(plan_.behind(i, profile_.elevation));
            set_goal(i, direction, beams_.free_length(i, direction, profile_.distance));
        }
    }

    [[nodiscard]] Spot spot_of(std::size_t knot, const Programme::Choice& choice) {
        const std::size_t i = knot * plan_.knot_spacing;
        const Look behind = plan_.behind(i, profile_.elevation);
        const Vec3f direction = direction_of(behind);
        if (angle_between(direction, directions_[choice.bin]) < snap_angle) {
            const float length = beams_.free_length(i, direction, profile_.distance);
            if (length >= choice.length - snap_length * profile_.unit) return {behind, length, true};
        }
        return {DirectionGrid::look(choice.bin), choice.length, false};
    }

    void set_goals(std::span<const Programme::Choice> choices) {
        Spot from = spot_of(0, choices[0]);
        for (std::size_t knot = 0; knot < choices.size(); ++knot) {
            const bool last = knot + 1 == choices.size();
            const Spot to = last ? from : spot_of(knot + 1, choices[knot + 1]);
            const std::size_t first = knot * plan_.knot_spacing;
            const std::size_t end = last ? plan_.count() : first + plan_.knot_spacing;
            for (std::size_t i = first; i < end; ++i) {
                const float share =
                    last ? 0.0F : static_cast<float>(i - first) / static_cast<float>(plan_.knot_spacing);
                set_goal(i, direction_of(between(from, to, share, i)),
                         from.length + share * (to.length - from.length));
            }
            from = to;
        }
    }
    [[nodiscard]] Look between(const Spot& from, const Spot& to, float share, std::size_t i) const {
        if (from.behind && to.behind) return plan_.behind(i, profile_.elevation);
        return {from.look.yaw + share * wrapped(to.look.yaw - from.look.yaw),
                from.look.pitch + share * (to.look.pitch - from.look.pitch)};
    }
    void set_goal(std::size_t i, const Vec3f& direction, float length) {
        plan_.length[i] = length;
        plan_.goal[i] = plan_.eye[i] + plan_.length[i] * direction.cast<double>();
    }

    const std::array<Vec3f, DirectionGrid::size>& directions_ = DirectionGrid::directions();
    const MapProfile& profile_;
    Beams& beams_;
    Plan& plan_;
    CandidateScratch& scratch_;
    Vec3f camera_;  // from the eye
    float turn_cost_;
};

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

void choose_directions(const MapProfile& profile, const History& history, Beams& beams, Plan& plan,
                       CandidateScratch& scratch) {
    Choosing(profile, history, beams, plan, scratch).run();
}

}  // namespace camdir::camera
