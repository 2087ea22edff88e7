// How far a command is, for whoever watches it.
#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace camdir::app {

// `[#####     ] 52 %`; `total` > 0.
[[nodiscard]] std::string bar(std::uint64_t done, std::uint64_t total);

// One line on standard error that is rewritten in place and cut to the terminal's width. Nothing when
// standard error is no terminal. Thread-safe.
class ProgressLine {
  public:
    ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine() { clear(); }

    // What is done, a bar, the seconds since the line was made. `total` 0 = unknown.
    void show(std::string_view what, std::uint64_t done, std::uint64_t total);

    // Any text and these seconds.
    void show(std::string_view text);

    // Before something else is printed.
    void clear();

  private:
    const bool terminal_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::string shown_;
};

}  // namespace camdir::app
