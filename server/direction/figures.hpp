// How good a programme is, by what it showed.
#pragma once

#include <span>
#include <vector>

#include "direction/editor.hpp"

namespace camdir::direction {

// All in whole beats. A kill of one player by another counts when the match has the time from 1 s before it
// to 0.5 s after it, and is seen when in every beat of that time the killer, or the victim, is shown. A
// multi-kill is seen when all of its kills are.
struct Figures {
    double kills = 0.0;
    double kills_seen = 0.0;
    double kills_seen_both = 0.0;  // killer and victim, in every beat
    double multi_kills = 0.0;      // two or more kills of one killer, each within 3 s of the one before
    double multi_kills_seen = 0.0;
    double cuts_per_minute = 0.0;  // with those of the cameras themselves
    // The lengths of what a viewer sees between two cuts, of the programme or of the camera itself, without
    // the last one's; 0 when there is none.
    double shot_s_p10 = 0.0;
    double shot_s_p50 = 0.0;
    double shot_s_p90 = 0.0;
    double shots_under_1_5 = 0.0;
    double jump_cuts = 0.0;
    double line_crossings = 0.0;
    // Of the time, 0 .. 1: on somebody who has been dead for more than 1 s or stands about, while two living
    // enemies within 1,200 units see each other.
    double idle_share = 0.0;
    double missed_by_cut = 0.0;  // kills not seen, with a cut in the second before
    // Of the given moments that are shown before they end, whoever of the two is shown: the mean time from
    // the begin to that, s; 0 when there are none. Those that are never shown do not count.
    double moment_delay_s = 0.0;
};

// `footage`: as the judge sees it; `moments`: for moment_delay_s. The shots cover all of it. `unit`: 0.0254 m
// in map units.
[[nodiscard]] Figures judge(const Footage& footage, std::span<const Event> events,
                            std::span<const Moment> moments, std::span<const Shot> shots,
                            const Grammar& grammar, double unit);

// Of the kills that count those that some rushes would show, each beat any of them: the bound of all
// programmes, whatever their grammar.
[[nodiscard]] std::size_t kills_in_reach(const Footage& footage, std::span<const Event> events);

// Of each kill: the programme shows it, as Figures::kills_seen counts it; false where the match lacks a part
// of its time.
[[nodiscard]] std::vector<bool> kills_shown(const Footage& footage, std::span<const Shot> shots,
                                            std::span<const Kill> kills);

// How long before and after a kill it is to be seen, and whether the match has all of that time.
inline constexpr double before_kill_s = 1.0;
inline constexpr double after_kill_s = 0.5;
[[nodiscard]] bool kill_counts(const Footage& footage, double kill_time);

// The mean of each. Precondition: at least one.
[[nodiscard]] Figures mean_of(std::span<const Figures> figures);

// Every figure's name, as in programs and tables, in order, and what it means, for people.
struct FigureName {
    const char* name;
    double Figures::*member;
    int decimals;  // worth printing
    const char* meaning;
};
[[nodiscard]] std::span<const FigureName> figure_names();

}  // namespace camdir::direction
