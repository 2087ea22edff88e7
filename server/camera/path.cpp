#include "camera/path.hpp"

#include <algorithm>

namespace camdir::camera {
namespace {

constexpr double motion_share = 1.45;  // of the profile's time constant
constexpr int rounds = 4;
constexpr int rounds_ahead = 5;
constexpr int distance_rounds = 3;
constexpr double distance_gain = 0.9;
constexpr double raise = 8.0;  // of the weight of a sample whose line of sight is blocked
constexpr double max_weight = 512.0;
constexpr float least_slide = 0.1F;  // share of what is blocked that a slide must be to be worth it

void solve(const MapProfile& profile, const History& history, Plan& plan) {
    const std::size_t count = plan.count();
    plan.smoother.factorise({plan.weights.data(), count},
                            stiffness(motion_share * profile.motion_smoothing, plan.future.step));
    for (std::size_t i = 0; i < count; ++i)
        plan.position[i] = plan.weights[i] * plan.goal[i];
    plan.smoother.solve(history[0].position, history[1].position, std::span(plan.position.data(), count));
}

// Whether anything was blocked.
bool avoid_obstacles(const MapProfile& profile, Beams& beams, Plan& plan) {
    bool blocked = false;
    for (std::size_t i = 0; i < plan.count(); ++i) {
        const Vec3f& eye = plan.future[i].eye;
        const Vec3f arm = plan.position[i].cast<float>() - eye;
        const float length = arm.norm();
        if (length < profile.unit) continue;
        const Vec3f direction = arm / length;
        const auto end = beams.end(i, direction, length);
        if (!end) continue;
        blocked = true;
        Vec3f free = end->free_length * direction;
        const float depth = end->normal.dot(arm - free);
        if (depth > least_slide * (length - end->free_length)) free = arm - depth * end->normal;
        plan.goal[i] = (eye + free).cast<double>();
        plan.length[i] = free.norm();
        plan.weights[i] = std::min(max_weight, plan.weights[i] * raise);
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

}  // namespace

void refine_path(const MapProfile& profile, const History& history, Beams& beams, Plan& plan) {
    std::fill_n(plan.weights.begin(), plan.count(), 1.0);
    solve(profile, history, plan);
    for (int round = 0; round < (plan.ahead ? rounds_ahead : rounds); ++round) {
        const bool blocked = avoid_obstacles(profile, beams, plan);
        if (!blocked && round >= distance_rounds) break;
        if (round < distance_rounds) keep_distance(profile, plan);
        solve(profile, history, plan);
    }
}

}  // namespace camdir::camera
