#include "camera/crowd.hpp"

#include <algorithm>
#include <optional>

namespace camdir::camera {
namespace {

constexpr double runs_on_for = 0.5;  // s, beyond the last pose

std::optional<Vec3f> eye_at(Window window, double time) {
    const std::ptrdiff_t index = index_at(window, time);
    if (index < 0) return {};
    const TimedPose& last = window[static_cast<std::size_t>(index)];
    if (!last.present || !last.pose.alive || !usable(last.pose)) return {};
    if (continuous(window, index)) {
        const TimedPose& next = window[static_cast<std::size_t>(index) + 1];
        const auto share = static_cast<float>((time - last.time) / (next.time - last.time));
        return last.pose.eye + share * (next.pose.eye - last.pose.eye);
    }
    const auto beyond = static_cast<float>(std::min(time - last.time, runs_on_for));
    return last.pose.eye + beyond * last.pose.velocity;
}

}  // namespace

Bystanders::Bystanders(const Crowd& crowd, const Vec3f& eye, double time, float range) {
    for (const auto& [id, window] : crowd.players) {
        const auto other = id == crowd.own ? std::nullopt : eye_at(window, time);
        if (!other) continue;
        const float distance = (*other - eye).norm();
        if (distance >= (count_ < capacity ? range : near_.back().distance)) continue;
        std::size_t place = count_ < capacity ? count_++ : capacity - 1;
        for (; place > 0 && near_[place - 1].distance > distance; --place)
            near_[place] = near_[place - 1];
        near_[place] = {distance, window};
    }
}

std::span<const Vec3f> Bystanders::eyes_at(double time) {
    std::size_t living = 0;
    for (std::size_t i = 0; i < count_; ++i)
        if (const auto eye = eye_at(near_[i].window, time)) eyes_[living++] = *eye;
    return std::span(eyes_).first(living);
}

}  // namespace camdir::camera
