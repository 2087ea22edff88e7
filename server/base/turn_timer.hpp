// Finds threads that hang, and tells how busy they are.
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
    void end() {
        const std::int64_t began = began_.exchange(idle, std::memory_order_relaxed);
        if (began != idle) busy_.fetch_add(now() - began, std::memory_order_relaxed);
    }

    // False when a turn goes on that began more than `limit` ago. Thread-safe.
    [[nodiscard]] bool within(std::chrono::nanoseconds limit) const {
        const std::int64_t began = began_.load(std::memory_order_relaxed);
        return began == idle || now() - began <= limit.count();
    }

    // Of all turns that have ended. Thread-safe.
    [[nodiscard]] std::chrono::nanoseconds busy() const {
        return std::chrono::nanoseconds(busy_.load(std::memory_order_relaxed));
    }

  private:
    static constexpr std::int64_t idle = 0;

    // In ns.
    static std::int64_t now() {
        return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
    }

    std::atomic<std::int64_t> began_{idle};
    std::atomic<std::int64_t> busy_{0};
};

}  // namespace camdir
