// The pose frames of a match as they come from its game server: how many, how punctual, what was held up.
#pragma once

#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>

#include "director/messages.hpp"

namespace camdir::director {

// When a pose frame came, on the steady clock in ns.
struct Receipt {
    std::int64_t received = 0;
    // When it would have come if it had been as fast on its way as the fastest of the last seconds, by its
    // sender's clock: up to 0.1 s earlier, and up to 10 s after a stall in which neither the sender's clock
    // nor the game's has stepped.
    std::int64_t punctual = 0;
    // Something on the way held it up and let it go together with the one before: they were sent at intervals
    // and came together, and no earlier than the fastest one lets expect, which those of a clock that runs
    // too fast do.
    bool in_burst = false;
};

// Judges the pose frames of one match. Thread-safe; times are the caller's.
class Arrivals {
  public:
    explicit Arrivals(std::int64_t max_per_second);  // >= 1

    // To be asked of every frame, in the order in which they come; any clock of its sender is possible, 0 is
    // none. Nothing for a frame that is to be left out, so that those that are not are even: max_per_second,
    // as many at once, and whatever a stall has held up. The discontinuities of the others are carried over
    // to them. A frame that is left out has other memory afterwards.
    [[nodiscard]] std::optional<Receipt> judge(PoseFrame& frame, std::int64_t now);

  private:
    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

    // Of the frame before.
    struct Sent {
        std::uint64_t epoch;
        std::int64_t source_time, frame_time;
        std::int64_t received;
    };

    [[nodiscard]] Receipt receive(const PoseFrame& frame, std::int64_t now);
    [[nodiscard]] bool goes_on(const PoseFrame& frame) const;
    [[nodiscard]] bool came_together(const PoseFrame& frame, std::int64_t now) const;
    void age(std::int64_t now);
    [[nodiscard]] bool has_room(std::int64_t punctual);

    std::mutex mutex_;
    const std::int64_t interval_;  // in which one frame is let in
    std::int64_t full_at_ = 0;     // when as many are let in at once as ever
    PoseFrame left_out_;

    std::optional<Sent> last_;
    // Times on the way from the sender, by two clocks: of this stretch of time and the one before.
    std::int64_t fastest_ = never;
    std::int64_t fastest_before_ = never;
    std::int64_t stretch_ends_ = 0;
    std::optional<std::int64_t> clock_offset_;  // of the sender's clock from the game's, as the stretch began
};

}  // namespace camdir::director
