#include "direction/cutter.hpp"

#include <algorithm>

namespace camdir::direction {

std::optional<Shot> Cutter::decide(const Material& material, std::span<const Moment> moments,
                                   const Rules& rules, double unit, Beat now,
                                   std::span<const std::size_t> choice) {
    on_air_.last_shown.resize(material.footage().rushes(), never_shown);
    if (on_air_.shot && !choice.empty() && std::ranges::find(choice, on_air_.shot->rush) == choice.end())
        on_air_.shot.reset();
    const Shot next = plan_shots(material.footage(), moments, rules, unit, on_air_, now, choice).front();
    on_air_.last_shown[next.rush] = now;
    if (on_air_.shot && on_air_.shot->rush == next.rush) return {};
    on_air_.shot = Shot{next.rush, now, now, next.reason};
    return on_air_.shot;
}

}  // namespace camdir::direction
