// How far a command is, for whoever watches it.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace camdir::app {

// One line on standard error that is rewritten in place: what is done, a bar, the seconds since the line was
// made. Nothing when standard error is no terminal. Thread-safe.
class ProgressLine {
  public:
    ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { clear(); }

    // `total` 0 = unknown.
    void show(std::string_view what, std::uint64_t done, std::uint64_t total);

    // Before something else is printed.
    void clear();

  private:
    const bool terminal_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::string shown_;
};

}  // namespace camdir::app
