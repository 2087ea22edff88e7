// Which game time to display now. Pure: all times are parameters, in ns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace camdir::sdk {

// Estimates the offset between the game's clock and this host's from the least delayed of the last 64 frames.
// Changes of the estimate are spread over time, so that the display does not jerk. One thread at a time.
class DisplayClock {
  public:
    explicit DisplayClock(std::int64_t delay) : delay_(delay) {}

    // A frame arrived at `now`, a monotonic time of this host.
    void observe(std::int64_t frame_time, std::int64_t now);

    // For a new epoch: frame_time starts again.
    void clear();

    // The game time to display: `delay` behind the game, not later than the newest frame, not earlier than a
    // time returned before. None before the first frame.
    [[nodiscard]] std::optional<std::int64_t> at(std::int64_t now);

  private:
    static constexpr std::size_t window = 64;
    static constexpr std::int64_t jump = 250'000'000;  // an offset this far off is no drift: the game paused
    static constexpr std::int64_t slew = 10;           // at most a tenth faster or slower than real time

    [[nodiscard]] std::int64_t target() const;

    std::int64_t delay_;
    std::array<std::int64_t, window> offsets_{};  // frame_time - now
    std::size_t observed_ = 0;
    std::int64_t newest_ = 0;
    std::int64_t offset_ = 0;  // in use
    std::int64_t last_now_ = 0;
    std::optional<std::int64_t> displayed_;
};

}  // namespace camdir::sdk
