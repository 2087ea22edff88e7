#include "camera/plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "camera/float4_angles.hpp"

namespace camdir::camera {
namespace {

constexpr float side_view_begin = 50.0F * radians_of_a_degree<float>;
constexpr double weight_in_dead_zone = 0.1;

// (time constant / time step)^4: what a second difference weighs against a deviation.
double stiffness(double time_constant, double step) {
    const double ratio = time_constant / step;
    return ratio * ratio * ratio * ratio;
}

}  // namespace

std::size_t Plan::samples_in(double seconds) const {
    return static_cast<std::size_t>(std::max(1L, std::lround(seconds / future.step)));
}

float Plan::side_view(const MapProfile& profile) {
    return side_view_begin + std::abs(profile.elevation);
}

Look Plan::behind(std::size_t i, float elevation) const {
    const double pitch =
        std::clamp(-heading_pitch[i] + elevation, -steepest_arm<double>, steepest_arm<double>);
    return {static_cast<float>(heading_yaw[i] + std::numbers::pi), static_cast<float>(pitch)};
}

void Plan::find_views() {
    for (std::size_t i = 0; i < count(); i += lane_count) {
        const auto look = [&](std::size_t k) { return future[std::min(i + k, count() - 1)].view; };
        const Directions four =
            directions_of(Float4{look(0).yaw, look(1).yaw, look(2).yaw, look(3).yaw},
                          Float4{look(0).pitch, look(1).pitch, look(2).pitch, look(3).pitch});
        for (int k = 0; k < lane_count; ++k)
            view[i + static_cast<std::size_t>(k)] = {four.x[k], four.y[k], four.z[k]};
    }
}

const Smoother& Plan::smoother(double time_constant) {
    const std::span<const double> all(weights.data(), count());
    const double wanted_stiffness = stiffness(time_constant, future.step);
    if (std::any_of(all.begin(), all.end(), [](double weight) { return weight != 1.0; })) {
        smoother_.factorise(all, wanted_stiffness);
        return smoother_;
    }
    for (const EvenSmoother& each : even_)
        if (each.count == count() && each.stiffness == wanted_stiffness) return each.smoother;
    EvenSmoother& made = even_[std::exchange(next_even_, (next_even_ + 1) % even_.size())];
    made.count = count();
    made.stiffness = wanted_stiffness;
    made.smoother.factorise(all, wanted_stiffness);
    return made.smoother;
}

void Plan::smooth(double time_constant, double before_last, double last, PerSample<double>& values) {
    for (std::size_t i = 0; i < count(); ++i)
        values[i] = weights[i] * wanted[i];
    smoother(time_constant).solve(before_last, last, std::span(values.data(), count()));
}

void Plan::smooth_with_dead_zone(double time_constant, double dead_zone, double gain, int rounds,
                                 double before_last, double last, PerSample<double>& values) {
    std::copy_n(weights.begin(), count(), weights_before.begin());
    smooth(time_constant, before_last, last, values);
    for (int round = 0; round < rounds; ++round) {
        bool same = true;
        for (std::size_t i = 0; i < count(); ++i) {
            const double off = std::abs(values[i] - wanted[i]);
            const double beyond = off > dead_zone ? gain * (off - dead_zone) / off : 0.0;
            const double before =
                std::exchange(weights[i], weights_before[i] * (weight_in_dead_zone + beyond));
            same = same && weights[i] == before;
        }
        if (same) break;
        smooth(time_constant, before_last, last, values);
    }
}

}  // namespace camdir::camera
