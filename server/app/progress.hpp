// The progress of a command on standard error.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace camdir::app {

// `[#####     ] 52 %`; `fraction` is 0 .. 1.
[[nodiscard]] std::string bar(double fraction);

// `12 s, about 40 s left`; without an estimate `12 s`.
[[nodiscard]] std::string times_text(double seconds, std::optional<double> remaining = {});

// On a terminal one line that is rewritten in place, several times a second, and cut to the terminal's width;
// elsewhere a line of its own every 10 seconds. Thread-safe.
class ProgressLine {
  public:
    // The text after `seconds` since the line was made. Called from any thread; must not use the line.
    using Text = std::function<std::string(double seconds)>;

    ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    ~ProgressLine();

    void show(Text text);
    // An activity, its bar, and the seconds since the line was made. A `total` of 0 is unknown: the line has
    // the count instead.
    void show(std::string_view activity, std::uint64_t done, std::uint64_t total);

    // Removes the line until the next show(), so that something else can be printed.
    void clear();

    [[nodiscard]] double seconds() const;

  private:
    void refresh(const std::stop_token& stop);
    void draw();  // with the mutex locked

    const bool terminal_;
    const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::condition_variable_any changed_;
    Text text_;               // null: nothing is shown
    std::string drawn_;       // on the terminal
    double printed_ = 0.0;    // when the last plain line was
    std::jthread refresher_;  // from the first show()
};

}  // namespace camdir::app
