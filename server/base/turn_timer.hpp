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
    void begin() {
        const std::int64_t time = now();
        went_on_.store(time, std::memory_order_relaxed);
        began_.store(time, std::memory_order_release);  // after went_on_, which within() reads next
    }
    // A part of the turn is done: it does not hang.
    void go_on() { went_on_.store(now(), std::memory_order_relaxed); }
    void end() {
        const std::int64_t began = began_.exchange(idle, std::memory_order_relaxed);
        if (began != idle) busy_.fetch_add(now() - began, std::memory_order_relaxed);
    }

    // False when a turn goes on that began, or went on, more than `limit` ago. Thread-safe.
    [[nodiscard]] bool within(std::chrono::nanoseconds limit) const {
        return began_.load(std::memory_order_acquire) == idle ||
               now() - went_on_.load(std::memory_order_relaxed) <= limit.count();
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
    std::atomic<std::int64_t> went_on_{0};
    std::atomic<std::int64_t> busy_{0};
};

}  // namespace camdir
