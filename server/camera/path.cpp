#include "camera/path.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::camera {
namespace {

constexpr double motion_share = 1.45;  // of the profile's time constant
constexpr int distance_rounds = 2;
constexpr double distance_gain = 1.1;
constexpr int rounds = 4;
constexpr int rounds_ahead = 5;
constexpr double raise = 8.0;  // of the weight of a sample whose line of sight is blocked
constexpr double max_weight = 512.0;
// Of a prediction, what comes later than this is looked at in steps of that, s.
constexpr double nearly_certain = 0.05;
constexpr double far_interval = 0.1;
// A spot moves round the player by this times what the path lags behind, and by no more than the other.
constexpr float round_gain = 2.0F;
constexpr float largest_round = 40.0F * radians_of_a_degree<float>;
constexpr float least_across = 1e-3F;  // sine
constexpr float least_slide = 0.1F;    // share of what is blocked that a slide must be to be worth it

void solve(const MapProfile& profile, const History& history, Plan& plan) {
    const std::size_t count = plan.count();
    for (std::size_t i = 0; i < count; ++i)
        plan.position[i] = plan.weights[i] * plan.goal[i];
    plan.smoother(motion_share * profile.motion_smoothing)
        .solve(history[0].position, history[1].position, std::span(plan.position.data(), count));
}

// Along what ends the line of sight of a sample or of one just before it.
void slide(const MapProfile& profile, const BeamEnd& end, std::size_t i, Plan& plan) {
    const Vec3f& eye = plan.future[i].eye;
    const Vec3f arm = plan.position[i].cast<float>() - eye;
    const float length = arm.norm();
    if (length < profile.unit || length <= end.free_length) return;
    Vec3f free = arm * (end.free_length / length);
    const float depth = end.normal.dot(arm - free);
    if (depth > least_slide * (length - end.free_length)) free = arm - depth * end.normal;
    plan.goal[i] = (eye + free).cast<double>();
    plan.length[i] = free.norm();
    plan.weights[i] = std::min(max_weight, plan.weights[i] * raise);
}

// Whether anything was blocked.
bool avoid_obstacles(const MapProfile& profile, Beams& beams, Plan& plan) {
    const std::size_t near = plan.ahead ? plan.count() : plan.samples_in(nearly_certain);
    const std::size_t stride = plan.samples_in(far_interval);
    bool blocked = false;
    for (std::size_t i = 0, next; i < plan.count(); i = next) {
        next = std::min(plan.count(), i + (i < near ? 1 : beams.to_next_of(stride, i)));
        const Vec3f arm = plan.position[i].cast<float>() - plan.future[i].eye;
        const float length = arm.norm();
        if (length < profile.unit) continue;
        const auto end = beams.end(i, arm / length, length);
        if (!end) continue;
        blocked = true;
        for (std::size_t k = i; k < next; ++k)
            slide(profile, *end, k, plan);
    }
    return blocked;
}

void keep_distance(const MapProfile& profile, Plan& plan) {
    for (std::size_t i = 0; i < plan.count(); ++i) {
        const Vec3d arm = plan.position[i] - plan.eye[i];
        const double length = arm.norm();
        if (length > profile.unit) plan.goal[i] += distance_gain * (plan.length[i] / length - 1.0) * arm;
    }
}

// Where the smoothed path would show the player from the side, the spot moves on round them.
void keep_behind(const MapProfile& profile, Plan& plan) {
    const float limit = Plan::side_view(profile);
    const float least_cosine = std::cos(limit);
    for (std::size_t i = 0; i < plan.count(); ++i) {
        const Vec3f arm = plan.position[i].cast<float>() - plan.future[i].eye;
        const Vec3f behind = -plan.view[i];
        const float length = arm.norm();
        const float along = arm.dot(behind);
        if (along >= least_cosine * length) continue;
        const Vec3f across = behind - arm * (along / (length * length));
        if (across.norm() < least_across) continue;  // in front of them: neither way round is nearer
        const float angle = std::min(round_gain * (angle_between(arm, behind) - limit), largest_round);
        const Vec3f moved = std::cos(angle) * arm + std::sin(angle) * length * across.normalized();
        plan.goal[i] += (moved - arm).cast<double>();
    }
}

}  // namespace

void refine_path(const MapProfile& profile, const History& history, Beams& beams, Plan& plan) {
    std::fill_n(plan.weights.begin(), plan.count(), 1.0);
    solve(profile, history, plan);
    for (int round = 0; round < distance_rounds; ++round) {
        keep_distance(profile, plan);
        if (round == 0) keep_behind(profile, plan);
        solve(profile, history, plan);
    }
    for (int round = 0; round < (plan.ahead ? rounds_ahead : rounds); ++round) {
        if (!avoid_obstacles(profile, beams, plan)) break;
        solve(profile, history, plan);
    }
}

}  // namespace camdir::camera
