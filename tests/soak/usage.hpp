// What processes use, and how busy the machine is.
#pragma once

#include <sys/types.h>

#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "timeline.hpp"

namespace camdir::soak {

// None when the process has ended.
[[nodiscard]] std::optional<Usage> usage_of(pid_t process);

// A thread on each processor that wants to run every 5 ms: for how long one does not, others had to wait
// there, too. One alone would be run wherever there is room. Thread-safe.
class Metronome {
  public:
    Metronome();

    // The longest delay since the last call, s.
    [[nodiscard]] double take_stall();

  private:
    void tick(int processor, const std::stop_token& stop);

    std::mutex mutex_;
    double stall_ = 0.0;
    std::vector<std::jthread> ticking_;
};

}  // namespace camdir::soak
