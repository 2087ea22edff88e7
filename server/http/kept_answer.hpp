// An answer that many ask for, and that is the same for all of them for a while.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace camdir::http {

// Thread-safe. Whoever comes while the answer is made waits for it.
class KeptAnswer {
  public:
    using Clock = std::chrono::steady_clock;

    KeptAnswer(std::function<std::string()> make, Clock::duration longest_age)
        : make_(std::move(make)), longest_age_(longest_age) {}

    // At most `longest_age` old.
    [[nodiscard]] std::string at(Clock::time_point now) {
        const std::lock_guard lock(mutex_);
        if (now >= stale_at_) {
            answer_ = make_();
            stale_at_ = now + longest_age_;
        }
        return answer_;
    }

  private:
    const std::function<std::string()> make_;
    const Clock::duration longest_age_;
    std::mutex mutex_;
    std::string answer_;
    Clock::time_point stale_at_ = Clock::time_point::min();
};

}  // namespace camdir::http
