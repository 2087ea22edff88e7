#include "camera/aim.hpp"

#include <algorithm>
#include <cmath>

#include "camera/float4_angles.hpp"

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
constexpr float least_horizontal = 1e-4F;  // share of a look that has a yaw of its own

// Looks of four samples.
struct FourLooks {
    Float4 yaw, pitch;
    Mask4 vertical;  // and so without a yaw
};

// From the cameras of the samples from i on to the player and on towards what they look at.
FourLooks looks_past(const MapProfile& profile, const Plan& plan, std::size_t i) {
    Float4 x, y, z, heading_yaw, heading_pitch;
    for (int k = 0; k < lane_count; ++k) {
        const std::size_t sample = std::min(i + static_cast<std::size_t>(k), plan.count() - 1);
        const Vec3f way = (plan.eye[sample] - plan.position[sample]).cast<float>();
        x[k] = way.x();
        y[k] = way.y();
        z[k] = way.z();
        heading_yaw[k] = static_cast<float>(plan.heading_yaw[sample]);
        heading_pitch[k] = static_cast<float>(plan.heading_pitch[sample]);
    }
    const Float4 horizontal2 = x * x + y * y;
    const Float4 pitch = arc_tangent(z, square_root(horizontal2));
    const Directions heading = directions_of(heading_yaw, heading_pitch);
    const Float4 lead = profile.lead_room * square_root(horizontal2 + z * z);
    x += lead * heading.x;
    y += lead * heading.y;
    z += lead * heading.z;
    const Float4 horizontal = square_root(x * x + y * y);
    const Float4 pitch_ahead = arc_tangent(z, horizontal);
    return {arc_tangent(y, x), pitch + upward_lead * (pitch_ahead - pitch),
            horizontal <= least_horizontal * larger(z, -z)};
}

}  // namespace

void aim(const MapProfile& profile, const History& history, Plan& plan) {
    const std::size_t count = plan.count();
    const double time_constant = (plan.ahead ? aim_share_ahead : aim_share) * profile.look_smoothing;
    const double dead_zone = plan.ahead ? off_middle_ahead : off_middle;
    const double softness = profile.look_smoothing / Profile{}.look_smoothing;
    const double sideways = dead_zone * std::clamp(softness, 1.0, max_sideways);
    double yaw = history[1].look_yaw;
    for (std::size_t i = 0; i < count; i += lane_count) {
        const FourLooks looks = looks_past(profile, plan, i);
        // Near the vertical a yaw moves the player little in the picture, but turns all of it.
        const Float4 level = sine_cosine(looks.pitch).cosine;
        for (std::size_t k = 0; k < std::min<std::size_t>(lane_count, count - i); ++k) {
            if (looks.vertical[k] == 0) yaw += wrapped(looks.yaw[k] - static_cast<float>(yaw));
            plan.wanted[i + k] = yaw;
            plan.look_pitch[i + k] =
                std::clamp(looks.pitch[k] + profile.framing_offset, -steepest_look, steepest_look);
            plan.weights[i + k] = std::max<double>(least_yaw_weight, level[k] * level[k]);
        }
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
