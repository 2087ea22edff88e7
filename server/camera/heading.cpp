#include "camera/heading.hpp"

#include <algorithm>

namespace camdir::camera {
namespace {

// Time constants, s, and shares of the profile's.
constexpr double yaw_share = 1.2;
constexpr double yaw_share_ahead = 1.5;
constexpr double pitch_share = 2.0;
constexpr double eye_smoothing = 0.03;
constexpr double eye_smoothing_ahead = 0.05;
// With a recorded future, short glances to the side are followed less.
constexpr double glance = 17.5 * radians_of_a_degree<double>;
constexpr double glance_gain = 2.0;
constexpr int glance_rounds = 3;

}  // namespace

void smooth_heading(const MapProfile& profile, const History& history, Plan& plan) {
    const std::size_t count = plan.count();
    const auto& [before_last, last] = history;
    std::fill_n(plan.weights.begin(), count, 1.0);
    for (std::size_t i = 0; i < count; ++i)
        plan.wanted[i] = plan.future[i].view.pitch;
    plan.smooth(pitch_share * profile.heading_smoothing, before_last.heading_pitch, last.heading_pitch,
                plan.heading_pitch);

    for (std::size_t i = 0; i < count; ++i)
        plan.eye[i] = plan.future[i].eye.cast<double>();
    plan.smoother(plan.ahead ? eye_smoothing_ahead : eye_smoothing)
        .solve(before_last.eye, last.eye, std::span(plan.eye.data(), count));

    for (std::size_t i = 0; i < count; ++i)
        plan.wanted[i] = plan.future[i].view.yaw;
    const double share = plan.ahead ? yaw_share_ahead : yaw_share;
    plan.smooth_with_dead_zone(share * profile.heading_smoothing, glance, glance_gain,
                               plan.ahead ? glance_rounds : 0, before_last.heading_yaw, last.heading_yaw,
                               plan.heading_yaw);
}

}  // namespace camdir::camera
