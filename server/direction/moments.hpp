// Moments: what is worth seeing, when, and of whom.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "direction/rules.hpp"

namespace camdir::direction {

struct Moment {
    Index rule = 0;  // of Rules::moments
    Beat begin = 0;  // from its first beat on
    Beat end = 0;    // to before this one
    Beat peak = 0;   // of the event; the begin of what has none
    Index actor = nobody;
    Index subject = nobody;
};

// Who is on a streak, carries a flag, and leads, by what has happened so far.
class Tally {
  public:
    // Of a streak from the kill that makes it one, of a lead from the one that takes it, of a flag from when
    // it is taken.
    struct Run {
        Index player = nobody;
        double since = 0.0;
    };
    struct Ended {
        std::optional<Run> streak;
        std::optional<Run> flag_run;
        std::optional<Run> lead;
    };

    // Events ascend by time; kills and flags count. Returns what ends with it.
    Ended count(const Event& event);

    [[nodiscard]] std::vector<Run> streaks() const;    // by player
    [[nodiscard]] std::vector<Run> flag_runs() const;  // likewise
    [[nodiscard]] std::vector<Run> leads() const;      // one at most

  private:
    struct Player {
        std::size_t kills = 0;
        std::size_t kills_of_this_life = 0;
        double streak_since = 0.0;
        std::optional<double> carries_since = {};
    };
    Player& player(Index index);
    std::optional<Run> end_flag_run(Index carrier);

    std::vector<Player> players_;
    std::optional<Run> lead_;
};

// What happened before this is not looked for: a decision needs no older events, except for the tally.
inline constexpr double memory_s = 30.0;

// The moments that reach into the beats `from` .. `footage.beats()`, by the footage from there on and the
// events before its end, in order of their begins. `events` ascend by time; `tally` is by those before
// them, which were over `memory_s` before `from`. Moments that go on at the end of what is known end there.
// `unit`: 0.0254 m in map units.
[[nodiscard]] std::vector<Moment> find_moments(const Footage& footage, std::span<const Event> events,
                                               const Rules& rules, double unit, Beat from,
                                               const Tally& tally = {});

// A kill, and which one began its chain: of the same killer's kills, each within 3 s of the one before.
struct Kill {
    double time = 0.0;
    Index killer = nobody;
    Index victim = nobody;
    std::size_t first = 0;  // of its chain, in the list of kills
};
[[nodiscard]] std::vector<Kill> kills_of(std::span<const Event> events);

}  // namespace camdir::direction
