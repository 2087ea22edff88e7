#include "camera/group/members.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace camdir::camera {
namespace {

constexpr double tick = 0.05;           // s: between recorded instants
constexpr double tick_rounding = 1e-6;  // of a tick: times that are whole ones, but for rounding
constexpr double least_recorded = 0.7;
constexpr std::size_t foreseen_instants = 4;
constexpr double foreseen_tick = 0.2;
// Running fades: nobody is taken to run on for longer.
constexpr float longest_run = 0.5F;  // s

Vec3f foreseen(const freespace::Space& space, const Pose& pose, double ahead) {
    const Vec3f end = pose.eye + pose.velocity * std::min(static_cast<float>(ahead), longest_run);
    const float way = (end - pose.eye).norm();
    if (way < 1e-3F) return pose.eye;
    const float free = freespace::sight(space, pose.eye, end).free_length;
    return pose.eye + (end - pose.eye) * (free / way);
}

// Of all windows.
double known_until(std::span<const Window> windows) {
    double until = std::numeric_limits<double>::infinity();
    for (const Window& window : windows)
        if (!window.empty() && window.back().present) until = std::min(until, window.back().time);
    return until;
}

Members::Instant instant_at(const freespace::Space& space, std::span<const Window> windows, double time,
                            double then) {
    Members::Instant instant;
    for (std::size_t member = 0; member < windows.size(); ++member) {
        const Window window = windows[member];
        const auto pose = pose_at(window, time, then);
        if (!pose) continue;
        instant.present |= only(member);
        instant.eyes[member] = pose->eye;
        if (!pose->alive) continue;
        instant.living |= only(member);
        const double beyond = then - window.back().time;
        if (beyond > 0.0) instant.eyes[member] = foreseen(space.at(then), *pose, beyond);
    }
    return instant;
}

}  // namespace

Members members_at(const freespace::Space& space, std::span<const Window> windows, double time) {
    Members members;
    const double until = known_until(windows);
    members.is_recorded = until >= time + least_recorded;
    members.first = static_cast<std::int64_t>(std::floor(time / tick + tick_rounding));
    const auto time_of = [&](std::size_t i) {
        if (i == 0) return time;
        return members.is_recorded ? static_cast<double>(members.first + static_cast<std::int64_t>(i)) * tick
                                   : time + static_cast<double>(i) * foreseen_tick;
    };
    const std::size_t most = members.is_recorded ? Members::most : foreseen_instants;
    for (std::size_t i = 0; i < most && (!members.is_recorded || time_of(i) <= until); ++i) {
        members.at[i] = instant_at(space, windows, time, time_of(i));
        members.ahead[i] = static_cast<float>(time_of(i) - time);
        members.known = i + 1;
    }
    return members;
}

}  // namespace camdir::camera
