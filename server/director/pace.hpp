// How often the cameras move: with every pose frame, or evenly less often where the machine is too small.
#pragma once

#include <atomic>
#include <cstdint>

namespace camdir::director {

// One pace for all matches, from the load that is observed at regular intervals. It slows down when frames of
// matches were replaced by newer ones in three intervals in a row, which is more than a stall reaches into:
// by the least that was missing in one of them. It speeds up by one step when the workers would have time to
// spare even then, after a calm time that doubles when it was too short, however many steps back it took, and
// that is halved by a step that held until the next.
class Pace {
  public:
    static constexpr std::uint32_t slowest = 8;

    // Of all matches in one interval.
    struct Load {
        std::uint64_t taken = 0;       // frames that were to become cameras, and did
        std::uint64_t superseded = 0;  // that a newer one has replaced, and not at once
        double busy = 0.0;             // share of their time that the workers were at work
    };

    // Of so many pose frames of a match one becomes cameras: 1 .. slowest. Thread-safe.
    [[nodiscard]] std::uint32_t frames_per_camera() const { return frames_.load(std::memory_order_relaxed); }

    // After each interval. One thread at a time.
    void observe(const Load& load);

  private:
    static constexpr std::uint32_t shortest_calm = 5;  // intervals
    static constexpr std::uint32_t longest_calm = 60;

    void slow_down();
    void speed_up();

    std::atomic<std::uint32_t> frames_{1};
    std::uint32_t late_ = 0;  // intervals in a row in which frames were superseded
    double missing_ = 1.0;    // all frames over those taken, the least of these intervals
    std::uint32_t calm_ = 0;  // and in which none was
    std::uint32_t calm_needed_ = shortest_calm;
    std::uint32_t calm_when_slowed_ = shortest_calm;  // what was needed after it last slowed down
    std::uint32_t since_speed_up_ = longest_calm;     // intervals
    bool last_step_was_up_ = false;
};

}  // namespace camdir::director
