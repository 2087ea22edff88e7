// What each rush is worth to see, beat by beat, by the moments that it shows.
#pragma once

#include <span>
#include <vector>

#include "direction/moments.hpp"
#include "direction/rules.hpp"

namespace camdir::direction {

// A moment that counts as a whole, and which rushes show it.
struct Credit {
    std::size_t moment = 0;  // of the moments
    Beat begin = 0;
    Beat end = 0;
    Beat peak = 0;
    double worth = 0.0;
    bool kill = false;
    // Of each rush: it shows the moment from its begin to before `until`, and from `from` to its end.
    std::vector<Beat> until;
    std::vector<Beat> from;
    std::vector<float> worth_both;  // of each rush that shows both players from begin to end, else 0
};

// Worth in points, of the beats now .. horizon.
class Value {
  public:
    // `last_shown[rush]`: the beat at which it was on the air last. What lies behind footage.beats() is the
    // mean of the last known beats, fading. `unit`: 0.0254 m in map units.
    Value(const Footage& footage, std::span<const Moment> moments, const Rules& rules, double unit,
          std::span<const Beat> last_shown, Beat now, Beat horizon);

    // Of the rush to before `beat`, now <= beat <= horizon, without the credits; from where does not matter
    // to differences.
    [[nodiscard]] double until(Beat beat, std::size_t rush) const {
        return sums_[static_cast<std::size_t>(beat - first_) * rushes_ + rush];
    }
    [[nodiscard]] std::span<const Credit> credits() const { return credits_; }

  private:
    void rate_beats();
    [[nodiscard]] double base_rate(Beat beat, std::size_t rush) const;
    void add_span(const Moment& moment, const Rule& rule);
    void add_players();
    void add_to_rushes(Beat beat, std::size_t word, Footage::Word rushes, double worth);
    void add_credit(std::size_t index, const Moment& moment, const Rule& rule);
    void look_through(const Moment& moment, std::size_t word, double worth_both, Credit& credit) const;
    void fade();
    void sum_up();
    double& worth_of_showing(Beat beat, Index player) {
        return worth_of_showing_[static_cast<std::size_t>(beat - first_) * footage_.players() + player];
    }
    double& rate(Beat beat, std::size_t rush) {
        return sums_[static_cast<std::size_t>(beat - first_ + 1) * rushes_ + rush];
    }

    const Footage& footage_;
    const Rules& rules_;
    double unit_;
    std::span<const Beat> last_shown_;
    Beat now_;
    Beat horizon_;
    Beat known_;        // the first beat that is not known
    Beat first_;        // that is rated
    Beat after_death_;  // beats for which a death may be looked at
    std::size_t rushes_;
    std::vector<double> sums_;
    std::vector<double> worth_of_showing_;  // of each known beat and player, by moments that last
    std::vector<Credit> credits_;
};

// The rush shows whom the moment is about.
[[nodiscard]] bool shows(const Take& take, const Moment& moment);

}  // namespace camdir::direction
