#include "camera/window.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::camera {
namespace {

constexpr float furthest = 1e7F;             // map units: no map reaches there
constexpr float fastest_player = 1e4F;       // units/s
constexpr float usual_frame = 1.0F / 60.0F;  // s
constexpr float shortest_frame = 1e-3F;      // s
constexpr float longest_frame = 0.25F;       // s
constexpr std::size_t kept_poses = 48;       // of a history that is full: more than are looked back at

bool seen(const TimedPose& each) {
    return each.present && usable(each.pose);
}

Pose interpolated(const TimedPose& a, const TimedPose& b, double time) {
    const auto share = static_cast<float>((time - a.time) / (b.time - a.time));
    Pose pose = a.pose;
    pose.eye += share * (b.pose.eye - a.pose.eye);
    pose.velocity += share * (b.pose.velocity - a.pose.velocity);
    pose.orientation = a.pose.orientation.normalized().slerp(share, b.pose.orientation.normalized());
    return pose;
}

}  // namespace

Vec3f plausible(const Vec3f& velocity, float unit) {
    const float speed = velocity.stableNorm();
    if (!std::isfinite(speed)) return Vec3f::Zero();
    const float limit = fastest_player * unit;
    return speed > limit ? Vec3f(velocity * (limit / speed)) : velocity;
}

bool usable(const Pose& pose) {
    const float norm = pose.orientation.norm();
    return pose.eye.allFinite() && pose.eye.cwiseAbs().maxCoeff() <= furthest && pose.velocity.allFinite() &&
           std::isfinite(norm) && norm > 1e-3F;
}

float usable_frame(double dt) {
    if (!std::isfinite(dt) || dt <= 0.0) return usual_frame;
    return static_cast<float>(std::clamp<double>(dt, shortest_frame, longest_frame));
}

std::ptrdiff_t index_at(Window window, double time) {
    const auto after = std::upper_bound(window.begin(), window.end(), time,
                                        [](double t, const TimedPose& each) { return t < each.time; });
    return after - window.begin() - 1;
}

bool continuous(Window window, std::ptrdiff_t index) {
    if (index < 0 || index + 1 >= std::ssize(window)) return false;
    const TimedPose& a = window[static_cast<std::size_t>(index)];
    const TimedPose& b = window[static_cast<std::size_t>(index) + 1];
    return seen(a) && seen(b) && a.pose.alive && b.pose.alive && !b.pose.discontinuity;
}

std::optional<Pose> pose_at(Window window, double since, double time) {
    const std::ptrdiff_t index = index_at(window, time);
    if (index < 0) return std::nullopt;
    const auto last = static_cast<std::size_t>(index);
    if (!seen(window[last])) return std::nullopt;
    Pose pose = continuous(window, index) && window[last].time < time
                    ? interpolated(window[last], window[last + 1], time)
                    : window[last].pose;
    pose.discontinuity = false;
    for (std::size_t i = last + 1; i-- > 0 && window[i].time > since;) {
        if (seen(window[i]) && window[i].pose.discontinuity) pose.discontinuity = true;
    }
    return pose;
}

void RecentPoses::add(double time, const Pose* pose) {
    if (count_ == poses_.size()) {
        std::move(poses_.end() - kept_poses, poses_.end(), poses_.begin());
        count_ = kept_poses;
    }
    poses_[count_++] = {time, pose != nullptr ? *pose : Pose{}, pose != nullptr};
}

}  // namespace camdir::camera
