#include "camera/aim.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::camera {
namespace {

// Shares of the profile's time constant.
constexpr double aim_share = 2.0;
constexpr double aim_share_ahead = 3.0;
// The player may be this far off the middle of the picture while the camera turns.
constexpr double off_middle = 10.0 * radians_of_a_degree<double>;
constexpr double off_middle_ahead = 8.0 * radians_of_a_degree<double>;
constexpr double off_middle_gain = 4.0;
// Times as far to the side, for a look that is smoothed more than usual.
constexpr double max_sideways = 2.0;
constexpr int off_middle_rounds = 2;
constexpr float upward_lead = 0.3F;  // share: the picture is wider than high
constexpr float steepest_look = 86.0F * radians_of_a_degree<float>;
constexpr double least_yaw_weight = 0.02;

// From the camera to the player and on towards what they look at; near `yaw`.
Look look_past(const MapProfile& profile, const Plan& plan, std::size_t i, float yaw) {
    const Vec3f way = (plan.eye[i] - plan.position[i]).cast<float>();
    const Look heading{static_cast<float>(plan.heading_yaw[i]), static_cast<float>(plan.heading_pitch[i])};
    Look look = look_along(way, yaw);
    const Look ahead = look_along(way + profile.lead_room * way.norm() * direction_of(heading), look.yaw);
    look.yaw = ahead.yaw;
    look.pitch += upward_lead * (ahead.pitch - look.pitch);
    return look;
}

}  // namespace

void aim(const MapProfile& profile, const History& history, Plan& plan) {
    const std::size_t count = plan.count();
    const double time_constant = (plan.ahead ? aim_share_ahead : aim_share) * profile.look_smoothing;
    const double dead_zone = plan.ahead ? off_middle_ahead : off_middle;
    const double softness = profile.look_smoothing / Profile{}.look_smoothing;
    const double sideways = dead_zone * std::clamp(softness, 1.0, max_sideways);
    double yaw = history[1].look_yaw;
    for (std::size_t i = 0; i < count; ++i) {
        const Look look = look_past(profile, plan, i, static_cast<float>(yaw));
        yaw += wrapped(look.yaw - static_cast<float>(yaw));
        plan.wanted[i] = yaw;
        plan.look_pitch[i] = std::clamp(look.pitch + profile.framing_offset, -steepest_look, steepest_look);
        // Near the vertical a yaw moves the player little in the picture, but turns all of it.
        const double level = std::cos(look.pitch);
        plan.weights[i] = std::max(least_yaw_weight, level * level);
    }
    plan.smooth_with_dead_zone(time_constant, sideways, off_middle_gain, off_middle_rounds,
                               history[0].look_yaw, history[1].look_yaw, plan.look_yaw);
    std::copy_n(plan.look_pitch.begin(), count, plan.wanted.begin());
    std::fill_n(plan.weights.begin(), count, 1.0);
    plan.smooth_with_dead_zone(time_constant, dead_zone, off_middle_gain, off_middle_rounds,
                               history[0].look_pitch, history[1].look_pitch, plan.look_pitch);
    for (std::size_t i = 0; i < count; ++i)  // the smoother swings further than what it smooths
        plan.look_pitch[i] = std::clamp<double>(plan.look_pitch[i], -steepest_look, steepest_look);
}

}  // namespace camdir::camera
