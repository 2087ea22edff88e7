// The editor: which rush is on the air when, over what is known of a match.
//
// A semi-Markov dynamic programme: of all sequences of shots from now to the end of the plan, the one whose
// moments are worth most, less the costs of the grammar. A pure function: the same arguments give the same
// plan. Sources: design of continuity editing by dynamic programming over shots of any length.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "direction/moments.hpp"
#include "direction/rules.hpp"

namespace camdir::direction {

// Why a shot begins.
struct Reason {
    enum class Why : std::uint8_t {
        opening,  // the first shot of the match
        moment,   // something worth seeing: rule, actor, subject
        death,    // the player shown before died
        hidden,   // the camera before had lost its player
        length,   // the shot before was long enough
    };
    Why why = Why::opening;
    Index rule = 0;
    Index actor = nobody;
    Index subject = nobody;
};

struct Shot {
    std::size_t rush = 0;
    Beat begin = 0;
    Beat end = 0;  // not of it any more
    Reason reason;
};

inline constexpr Beat never_shown = -1'000'000;

// What was shown so far.
struct OnAir {
    std::optional<Shot> shot;      // whose end is not known
    std::vector<Beat> last_shown;  // of each rush
};

// Cuts are made at beats that are multiples of this.
inline constexpr Beat cut_every = 2;

// The shots from `now` on, the first of which goes on with the shot on the air or replaces it at once. They
// cover the beats to the end of the plan, which is the grammar's foresight behind what is known. `moments`:
// find_moments() of the footage. `unit`: 0.0254 m in map units. `choice`: the rushes that may be on the air;
// empty: all. Preconditions: a rush; what is on the air is of the choice; `now`, where nothing is on the air
// or a cut is to be made, is a multiple of cut_every. Thread-safe.
[[nodiscard]] std::vector<Shot> plan_shots(const Footage& footage, std::span<const Moment> moments,
                                           const Rules& rules, double unit, const OnAir& on_air, Beat now,
                                           std::span<const std::size_t> choice = {});

// "opening", "death", "lost sight" or "length"; of a moment the name of its rule.
[[nodiscard]] std::string_view name_of(const Reason& reason, const Rules& rules);
// Whether it is the name of a reason that is no moment.
[[nodiscard]] bool is_reason_without_moment(std::string_view name);

}  // namespace camdir::direction
