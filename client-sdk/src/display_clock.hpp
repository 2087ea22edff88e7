// Which moment of the game to display now. Pure: every time is passed in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace camdir::sdk {

// Follows the game's frame_time by the frames' arrival. The frame that was least delayed of the last 64 tells
// how the two clocks lie; what that changes is spread over time, so that the display does not jerk.
class DisplayClock {
  public:
    explicit DisplayClock(std::int64_t delay) : delay_(delay) {}

    // A frame arrived at `now`, a clock of this host that never goes back. Nanoseconds, as everywhere here.
    void observe(std::int64_t frame_time, std::int64_t now);

    // Another epoch: frame_time starts anew.
    void clear();

    // `delay` behind the game, never later than the newest frame, never earlier than a time returned before.
    // None before the first frame.
    [[nodiscard]] std::optional<std::int64_t> at(std::int64_t now);

  private:
    static constexpr std::size_t window = 64;
    static constexpr std::int64_t jump = 250'000'000;  // a clock this far off did not drift: the game paused
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
