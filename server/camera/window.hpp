// What is known of a player in time: recorded poses, from some history to as far ahead as a delay allows.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "camera/camera.hpp"

namespace camdir::camera {

struct TimedPose {
    double time = 0.0;  // s, by the game's clock
    Pose pose;
    bool present = true;  // false: the player has no pose from here to the next one
};

// Ascending strictly by time. A continuous stretch has no absence, death, respawn or teleport in it.
using Window = std::span<const TimedPose>;

// Finite position, velocity and rotation within 1e7 map units of the origin: everything else counts as no
// pose.
[[nodiscard]] bool usable(const Pose& pose);

// No faster than players move, 10,000 units of 0.0254 m a second, each `unit` map units: more is a jump. Zero
// where the speed is not finite.
[[nodiscard]] Vec3f plausible(const Vec3f& velocity, float unit);

// The time since a shot's last step, s: one frame of 60 Hz where it is <= 0 or not finite, and limited to
// 1 ms .. 250 ms.
[[nodiscard]] float usable_frame(double dt);

// The index of the last pose at or before `time`; -1 before the first.
[[nodiscard]] std::ptrdiff_t index_at(Window window, double time);

// The pose at `time`: interpolated between its neighbours within a continuous stretch, else the one before.
// None when there is none, or none that is usable. `discontinuity` says that a pose after `since` had it:
// the player came by a respawn or teleport.
[[nodiscard]] std::optional<Pose> pose_at(Window window, double since, double time);

// Whether poses `index` and `index` + 1 belong to one continuous stretch of a living player.
[[nodiscard]] bool continuous(Window window, std::ptrdiff_t index);

// The last poses of a shot that is given one after the other. A value.
class RecentPoses {
  public:
    // At a later time than the last one's; null, or a pose that is not usable: the player has none.
    void add(double time, const Pose* pose);
    [[nodiscard]] Window window() const { return {poses_.data(), count_}; }

  private:
    std::array<TimedPose, 64> poses_;
    std::size_t count_ = 0;
};

}  // namespace camdir::camera
