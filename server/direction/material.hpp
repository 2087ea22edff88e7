// What is known of a match that goes on: its footage and its events, as they become known.
#pragma once

#include <vector>

#include "direction/moments.hpp"

namespace camdir::direction {

// One thread at a time. Without forget_before() it grows; with it, it keeps less than a minute.
class Material {
  public:
    static constexpr std::size_t max_events = 8192;

    Material(std::size_t players, std::vector<Index> followed) : footage_(players, std::move(followed)) {}

    // As Footage does.
    void append(std::span<const PlayerState> players, std::span<const Take> takes) {
        footage_.append(players, takes);
    }
    void add_player() { footage_.add_player(); }

    // In any order; its time may not be known yet. Of more than max_events the oldest are forgotten.
    void add(const Event& event);

    // What no decision at `now` or later needs; their kills still count for streaks and leads.
    void forget_before(Beat now);

    [[nodiscard]] const Footage& footage() const { return footage_; }

    // That a decision at `now` needs.
    [[nodiscard]] std::vector<Moment> moments(const Rules& rules, double unit, Beat now) const;

  private:
    void forget_events(std::size_t count);

    Footage footage_;
    std::vector<Event> events_;  // ascending by time
    Tally tally_;                // by those that were forgotten
};

}  // namespace camdir::direction
