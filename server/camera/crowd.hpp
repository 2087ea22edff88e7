// The players round a shot's own. Their bodies are soft: the planner avoids directions in which they would be
// in the way, where there is another.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "camera/window.hpp"

namespace camdir::camera {

struct Crowd {
    struct Player {
        std::uint32_t id = 0;
        Window window;
    };
    std::span<const Player> players;  // of a match; those who are dead or absent are nowhere
    std::uint32_t own = 0;            // whose shot it is: not in their own way
};

// Those of a crowd who are near at the beginning of a plan. Beyond their last pose they run on for 0.5 s.
class Bystanders {
  public:
    static constexpr std::size_t capacity = 8;

    // Who is nearer to `eye` than `range` at `time`; of more than `capacity` the nearest.
    Bystanders(const Crowd& crowd, const Vec3f& eye, double time, float range);

    [[nodiscard]] bool empty() const { return count_ == 0; }
    // The eyes of those who live then. Valid until the next call.
    [[nodiscard]] std::span<const Vec3f> eyes_at(double time);

  private:
    struct Near {
        float distance = 0.0F;
        Window window;
    };

    std::array<Near, capacity> near_;  // ascending
    std::array<Vec3f, capacity> eyes_;
    std::size_t count_ = 0;
};

}  // namespace camdir::camera
