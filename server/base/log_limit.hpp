// Limits the rate of log lines that other processes can provoke.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <optional>

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

}  // namespace camdir
