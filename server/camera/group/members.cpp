#include "camera/group/members.hpp"

#include <algorithm>
#include <limits>

namespace camdir::camera {
namespace {

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

}  // namespace

Members members_at(const freespace::Space& space, std::span<const Window> windows, double time) {
    Members members;
    const double until = known_until(windows);
    for (std::size_t i = 0; i < Members::instants.size(); ++i) {
        const double then = time + static_cast<double>(Members::instants[i]);
        if (i >= Members::foreseen && then > until) break;
        members.known = i + 1;
        Members::Instant& instant = members.at[i];
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
    }
    return members;
}

}  // namespace camdir::camera
