// Finds threads that hang.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace camdir {

// The time that one thread is busy with one turn of its work.
class TurnTimer {
  public:
    // Called by the thread.
    void begin() { began_.store(now(), std::memory_order_relaxed); }
    void end() { began_.store(idle, std::memory_order_relaxed); }

    // False when a turn goes on that began more than `limit` ago. Thread-safe.
    [[nodiscard]] bool within(std::chrono::nanoseconds limit) const {
        const std::int64_t began = began_.load(std::memory_order_relaxed);
        return began == idle || now() - began <= limit.count();
    }

  private:
    static constexpr std::int64_t idle = 0;

    // In ns.
    static std::int64_t now() {
        return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
    }

    std::atomic<std::int64_t> began_{idle};
};

}  // namespace camdir
