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
// Of a prediction, what comes later than this is looked at in steps of that, s.
constexpr double nearly_certain = 0.1;
constexpr double far_interval = 0.05;
constexpr float least_slide = 0.1F;  // share of what is blocked that a slide must be to be worth it

void solve(const MapProfile& profile, const History& history, Plan& plan) {
    const std::size_t count = plan.count();
    plan.smoother.factorise({plan.weights.data(), count},
                            stiffness(motion_share * profile.motion_smoothing, plan.future.step));
    for (std::size_t i = 0; i < count; ++i)
        plan.position[i] = plan.weights[i] * plan.goal[i];
    plan.smoother.solve(history[0].position, history[1].position, std::span(plan.position.data(), count));
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
        next = std::min(plan.count(), i + (i < near ? 1 : stride));
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
