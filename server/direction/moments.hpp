// Moments: what is worth seeing, when, and of whom.
#pragma once

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

// The moments that reach into the beats `from` .. `footage.beats()`, by the footage from there on and the
// events before its end, in order of their begins. `events` ascend by time and begin with the match's
// first: streaks and leads need all, what else they begin is found up to 30 s before `from`. Moments that go
// on at the end of what is known end there. `unit`: 0.0254 m in map units.
[[nodiscard]] std::vector<Moment> find_moments(const Footage& footage, std::span<const Event> events,
                                               const Rules& rules, double unit, Beat from);

// A kill, and how many of the same killer's kills it ends, each within 3 s of the one before.
struct Kill {
    double time = 0.0;
    Index killer = nobody;
    Index victim = nobody;
    std::size_t first = 0;  // of its chain, in the list of kills
};
[[nodiscard]] std::vector<Kill> kills_of(std::span<const Event> events);

}  // namespace camdir::direction
