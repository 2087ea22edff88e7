// Matches that have something left to be done.
#pragma once

#include <chrono>
#include <deque>
#include <string>
#include <unordered_set>
#include <utility>

namespace camdir::dds {

// They take turns, a step each, for a limited time: however much there is, nothing else waits for long. One
// thread at a time.
class TurnQueue {
  public:
    using Clock = std::chrono::steady_clock;

    // Its turn comes after those of the others; nothing where it waits already.
    void add(const std::string& match_id) {
        if (waiting_.insert(match_id).second) order_.push_back(match_id);
    }
    // Since when take_turns() has something to do; max() where it has nothing.
    [[nodiscard]] Clock::time_point due() const { return order_.empty() ? Clock::time_point::max() : due_; }
    // Calls step(match_id), which returns whether the match has another, until all are done or this time.
    // Returns whether some are left.
    template <class Step>
    bool take_turns(Clock::time_point end, const Step& step) {
        while (!order_.empty() && Clock::now() < end) {
            const std::string match_id = std::move(order_.front());
            order_.pop_front();
            waiting_.erase(match_id);
            if (step(match_id)) add(match_id);
        }
        return !order_.empty();
    }
    // The next turn is not due before.
    void pause_until(Clock::time_point then) { due_ = then; }

  private:
    std::deque<std::string> order_;
    std::unordered_set<std::string> waiting_;  // the same matches
    Clock::time_point due_{};
};

}  // namespace camdir::dds
