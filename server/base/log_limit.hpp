// Limits the rate of log lines that other processes can provoke.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>
#include <utility>

namespace camdir {

// One kind of line, at most one per second. Thread-safe.
class LogLimit {
  public:
    // Counts an occurrence. Returns, when a line is due, the occurrences since the last line including this
    // one.
    [[nodiscard]] std::optional<std::uint64_t> due() {
        const std::uint64_t count = ++unlogged_;
        const std::int64_t now = std::chrono::steady_clock::now().time_since_epoch().count();
        std::int64_t next = next_;
        if (now < next || !next_.compare_exchange_strong(next, now + second)) return std::nullopt;
        unlogged_ -= count;
        return count;
    }

  private:
    static constexpr std::int64_t second =
        std::chrono::steady_clock::duration(std::chrono::seconds(1)).count();
    std::atomic<std::int64_t> next_{0};
    std::atomic<std::uint64_t> unlogged_{0};
};

// Lines of many kinds, at most `per_second` in a second. Thread-safe.
class LogBudget {
  public:
    using Time = std::chrono::steady_clock::time_point;

    explicit LogBudget(std::uint64_t per_second) : per_second_(per_second) {}

    // Nothing when there is no room for a line now; for a `vital` one there always is. Otherwise how many had
    // none since the last line.
    [[nodiscard]] std::optional<std::uint64_t> take(Time now, bool vital = false) {
        const std::lock_guard lock(mutex_);
        if (now - begun_ >= std::chrono::seconds(1)) {
            begun_ = now;
            lines_ = 0;
        }
        if (lines_ >= per_second_ && !vital) {
            ++left_out_;
            return std::nullopt;
        }
        ++lines_;
        return std::exchange(left_out_, 0);
    }

  private:
    const std::uint64_t per_second_;
    std::mutex mutex_;
    Time begun_{};
    std::uint64_t lines_ = 0, left_out_ = 0;
};

}  // namespace camdir
