// Which pose frames of a match something on their way has held up, so that they come together.
#pragma once

#include <cstdint>
#include <optional>

#include "director/messages.hpp"

namespace camdir::director {

// Judged by the sender's clock: frames that were sent at intervals and came together, and no earlier than the
// most punctual one before lets expect, which those of a clock that runs too fast do. Once they are longer on
// their way than that one, by a longer delay for example, a fast clock may make them look like a burst.
class Burst {
  public:
    // To be asked of every frame of a match, in the order in which they come: whether it is of one burst with
    // the one before. Any source_time is possible; 0 is none.
    [[nodiscard]] bool goes_on_with(const PoseFrame& frame, std::int64_t received_ns);

  private:
    struct Arrival {
        std::uint64_t epoch;
        double sent_ns;
        double received_ns;
    };

    std::optional<Arrival> last_;
    std::optional<Arrival> punctual_;
};

}  // namespace camdir::director
