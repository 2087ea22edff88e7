// What closed connections and refused requests because a bound was reached.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace camdir::http {

enum class Bound : std::size_t {
    connections,   // too many: the oldest was closed
    files,         // the process could open no more: the oldest was closed
    idle_time,     // Limits::idle
    request_time,  // Limits::request
    answer_time,   // Limits::answer
    header_size,
    body_size,
    slow_pages,       // Limits::slow_pages
    viewers,          // the relay's
    viewer_messages,  // a viewer sent something
    count
};
inline constexpr std::array<const char*, static_cast<std::size_t>(Bound::count)> bound_names = {
    "connections", "files",     "idle_time",  "request_time", "answer_time",
    "header_size", "body_size", "slow_pages", "viewers",      "viewer_messages"};

// Counts since the start. Thread-safe.
class BoundCounters {
  public:
    void add(Bound bound) {
        counts_[static_cast<std::size_t>(bound)].fetch_add(1, std::memory_order_relaxed);
    }
    [[nodiscard]] std::uint64_t operator[](Bound bound) const {
        return counts_[static_cast<std::size_t>(bound)].load(std::memory_order_relaxed);
    }

  private:
    std::array<std::atomic<std::uint64_t>, bound_names.size()> counts_{};
};

}  // namespace camdir::http
