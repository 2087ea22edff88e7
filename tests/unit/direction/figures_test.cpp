#include "direction/figures.hpp"

#include <gtest/gtest.h>

#include "small_match.hpp"

namespace camdir::direction {
namespace {

using test::kill;
using test::Script;

Figures judged(const Script& script, const std::vector<Event>& events, const std::vector<Shot>& shots,
               const std::vector<Moment>& moments = {}) {
    return judge(script.footage(), events, moments, shots, Grammar{}, test::unit);
}

TEST(Figures, AKillIsSeenByWhoeverIsShownInEveryBeat) {
    Script script(3, 100);
    const std::vector<Shot> shots = {{0, 0, 60, {}}, {1, 60, 100, {}}};
    // Until the cut player 0 is shown, then player 1.
    const std::vector<Event> events = {kill(2.0, 0, 2), kill(3.0, 2, 1), kill(6.2, 0, 1),
                                       kill(6.5, 0, 2), kill(0.5, 0, 1), kill(9.8, 0, 1)};
    auto sorted = events;
    std::ranges::sort(sorted, {}, &Event::time);
    const Figures figures = judged(script, sorted, shots);
    EXPECT_EQ(figures.kills, 4.0);       // without those too near to the ends
    EXPECT_EQ(figures.kills_seen, 2.0);  // at 2.0, and at 6.2 across the cut
    EXPECT_EQ(figures.kills_seen_both, 0.0);
    EXPECT_EQ(figures.missed_by_cut, 1.0);  // at 6.5, half a second after the cut
}

TEST(Figures, OneBeatWithoutThemLosesTheKill) {
    Script script(2, 60);
    for (std::size_t beat = 0; beat < 60; ++beat)
        script.take(beat, 0).shown.set(1);
    const std::vector<Shot> shots = {{0, 0, 60, {}}};
    const std::vector<Event> events = {kill(3.0, 0, 1)};
    EXPECT_EQ(judged(script, events, shots).kills_seen_both, 1.0);
    script.take(20, 0).shown.reset(1);
    EXPECT_EQ(judged(script, events, shots).kills_seen, 1.0);
    EXPECT_EQ(judged(script, events, shots).kills_seen_both, 0.0);
    script.take(35, 0).shown.reset();
    EXPECT_EQ(judged(script, events, shots).kills_seen, 0.0);
}

TEST(Figures, MomentsAreShownSoonerOrLater) {
    const Script script(4, 100);
    const std::vector<Shot> shots = {{0, 0, 60, {}}, {1, 60, 100, {}}};
    const std::vector<Moment> moments = {{0, 10, 20, 15, 2, 0},   // at once
                                         {0, 50, 70, 55, 1, 2},   // after the cut
                                         {0, 10, 20, 15, 3, 2}};  // never
    EXPECT_DOUBLE_EQ(judged(script, {}, shots, moments).moment_delay_s, 0.5);
    EXPECT_EQ(judged(script, {}, shots, {moments.back()}).moment_delay_s, 0.0);
}

TEST(Figures, AKillIsInReachOfWhateverRushesShowIt) {
    Script script(3, 60);
    const std::vector<Event> events = {kill(3.0, 0, 1), kill(5.9, 0, 1)};  // the match lacks the second's end
    EXPECT_EQ(kills_in_reach(script.footage(), events), 1U);
    script.take(30, 0).shown.reset();  // then player 1's rush
    EXPECT_EQ(kills_in_reach(script.footage(), events), 1U);
    script.take(30, 1).shown.reset();
    EXPECT_EQ(kills_in_reach(script.footage(), events), 0U);
}

TEST(Figures, AMultiKillIsSeenFromItsFirst) {
    Script script(3, 120);
    const std::vector<Event> events = {kill(3.0, 0, 1), kill(5.0, 0, 2)};
    EXPECT_EQ(judged(script, events, {{0, 0, 120, {}}}).multi_kills_seen, 1.0);
    const Figures late = judged(script, events, {{1, 0, 36, {}}, {0, 36, 120, {}}});
    EXPECT_EQ(late.kills_seen, 2.0);
    EXPECT_EQ(late.multi_kills_seen, 1.0);
    const Figures missed = judged(script, events, {{2, 0, 36, {}}, {0, 36, 120, {}}});
    EXPECT_EQ(missed.kills_seen, 1.0);
    EXPECT_EQ(missed.multi_kills, 1.0);
    EXPECT_EQ(missed.multi_kills_seen, 0.0);
}

TEST(Figures, PiecesAreMeasuredWithoutTheLast) {
    Script script(2, 200);
    script.take(124, 1).cut = true;
    script.take(80, 1).cut = true;  // of a camera that is not on the air
    const std::vector<Shot> shots = {{0, 0, 30, {}}, {1, 30, 44, {}}, {0, 44, 114, {}}, {1, 114, 200, {}}};
    const Figures figures = judged(script, {}, shots);
    EXPECT_DOUBLE_EQ(figures.shot_s_p10, 1.0);  // 3, 1.4, 7 and 1 s
    EXPECT_DOUBLE_EQ(figures.shot_s_p50, 3.0);
    EXPECT_DOUBLE_EQ(figures.shot_s_p90, 7.0);
    EXPECT_EQ(figures.shots_under_1_5, 2.0);
    EXPECT_DOUBLE_EQ(figures.cuts_per_minute, 4.0 * 3.0);
}

TEST(Figures, AJumpJustAfterACutLeavesAFragment) {
    Script script(2, 100);
    script.take(50, 1).jump(true);
    const std::vector<Shot> shots = {{0, 0, 50, {}}, {1, 50, 100, {}}};
    EXPECT_EQ(judged(script, {}, shots).shots_under_1_5, 0.0);
    script.take(75, 1).jump(false);  // within the shot
    EXPECT_EQ(judged(script, {}, shots).shots_under_1_5, 0.0);
    script.take(50, 1).jump(false);
    EXPECT_EQ(judged(script, {}, shots).shots_under_1_5, 1.0);
}

TEST(Figures, TheDeadAreIdleASecondLaterWhileOthersFight) {
    Script script(3, 100);
    for (std::size_t beat = 20; beat < 60; ++beat)
        script.player(beat, 0).alive = false;
    for (std::size_t beat = 0; beat < 50; ++beat)
        script.meet(beat, 1, 2);
    EXPECT_DOUBLE_EQ(judged(script, {}, {{0, 0, 100, {}}}).idle_share, 0.2);  // beats 30 to 49
    EXPECT_DOUBLE_EQ(judged(script, {}, {{1, 0, 100, {}}}).idle_share, 0.0);
}

TEST(Figures, TheMeanIsOfEachFigure) {
    Figures one;
    one.kills = 2.0;
    Figures other;
    other.kills = 4.0;
    other.idle_share = 1.0;
    const Figures both[] = {one, other};
    EXPECT_EQ(mean_of(both).kills, 3.0);
    EXPECT_EQ(mean_of(both).idle_share, 0.5);
}

}  // namespace
}  // namespace camdir::direction
