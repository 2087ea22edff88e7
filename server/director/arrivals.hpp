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
    // Something on the way held it up and let it go together with the one before: by the sender's clock they
    // were sent at intervals, and came together no earlier than the fastest one lets expect, which those of a
    // clock that runs too fast do. Once all are longer on their way than that one, by a longer delay for
    // example, a fast clock may make them look like a burst.
    bool in_burst = false;
};

// Judges the pose frames of one match. Thread-safe; times are the caller's.
class Arrivals {
  public:
    explicit Arrivals(std::int64_t max_per_second);  // >= 1

    // To be asked of every frame, in the order in which they come; any clock of its sender is possible, 0 is
    // none. Nothing for a frame that is to be left out, so that those that are not are even: on average
    // max_per_second and 2 % more, those of 4 s at once, and whatever a stall has held up, where the sender's
    // clock tells. The discontinuities of the others are carried over to them. A frame that is left out has
    // other memory afterwards.
    [[nodiscard]] std::optional<Receipt> judge(PoseFrame& frame, std::int64_t now);

  private:
    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();

    // Of the frame before.
    struct Sent {
        std::uint64_t epoch;
        std::int64_t source_time, frame_time;
        std::int64_t received;
    };

    [[nodiscard]] std::int64_t punctual_receipt(const PoseFrame& frame, std::int64_t now);
    [[nodiscard]] bool goes_on(const PoseFrame& frame) const;
    void age(std::int64_t now);
    [[nodiscard]] bool is_in_burst(const PoseFrame& frame, std::int64_t now);
    [[nodiscard]] bool has_room(const Receipt& receipt);

    std::mutex mutex_;
    const std::int64_t interval_;  // in which one frame is let in
    // When as many are let in at once as ever, by the times of receipt and by the punctual ones.
    std::int64_t full_at_ = 0;
    std::int64_t full_at_by_sender_ = 0;
    PoseFrame left_out_;

    std::optional<Sent> last_;
    // Times on the way from the sender, by two clocks: of this stretch of time and the one before.
    std::int64_t fastest_ = never;
    std::int64_t fastest_before_ = never;
    std::int64_t stretch_ends_ = 0;
    std::optional<std::int64_t> clock_offset_;  // of the sender's clock from the game's, as the stretch began
    std::int64_t fastest_of_all_ = never;       // since the epoch began, or the sender's clock went back
};

}  // namespace camdir::director
