#include "direction/moments.hpp"

#include <gtest/gtest.h>

#include <tuple>

#include "small_match.hpp"

namespace camdir::direction {
namespace {

using test::kill;
using test::Script;

Rules only(Rule rule) {
    Rules rules;
    rules.moments = {std::move(rule)};
    return rules;
}

TEST(Moments, ASightLastsAsLongAsItHolds) {
    Script script(2, 20);
    for (std::size_t beat = 5; beat < 9; ++beat)
        script.meet(beat, 0, 1);
    script.player(7, 1).alive = false;
    const auto found = find_moments(script.footage(), {}, only({.name = "tested", .trigger = Trigger::sight}),
                                    test::unit, 0);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].begin, 5);
    EXPECT_EQ(found[0].end, 7);
    EXPECT_EQ(found[1].begin, 8);
    EXPECT_EQ(found[1].end, 9);
    EXPECT_EQ(found[0].actor, 0);
    EXPECT_EQ(found[0].subject, 1);
}

TEST(Moments, ASightEndsAtItsRangeAndWantsSomebodyToFaceTheOther) {
    Script script(2, 3);
    for (std::size_t beat = 0; beat < 3; ++beat)
        script.meet(beat, 0, 1);  // 100 units apart; 0 looks along x, at 1; 1 looks away
    script.player(1, 1).eye.x() = 101.5F;
    script.player(2, 0).facing = -Vec3f::UnitX();
    const auto found = find_moments(
        script.footage(), {},
        only({.name = "tested", .trigger = Trigger::sight, .range = 101.0, .facing = 11.0}), test::unit, 0);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].begin, 0);
    EXPECT_EQ(found[0].end, 1);
}

TEST(Moments, TeammatesDoNotMeet) {
    Script script(2, 3);
    script.meet(1, 0, 1);
    script.player(1, 0).team = script.player(1, 1).team = 1;
    EXPECT_TRUE(
        find_moments(script.footage(), {}, only({.name = "tested", .trigger = Trigger::sight}), test::unit, 0)
            .empty());
}

TEST(Moments, AKillReachesFromBeforeToAfterAndNoFurtherThanIsKnown) {
    const Rules rules =
        only({.name = "tested", .trigger = Trigger::kill, .before_s = 1.0, .after_s = 0.5, .whole = true});
    const std::vector<Event> events = {kill(0.45, 0, 1), kill(2.03, 1, 0), kill(2.9, 0, 1)};
    const auto found = find_moments(Script(2, 30).footage(), events, rules, test::unit, 0);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].begin, 0);
    EXPECT_EQ(found[0].end, 10);
    EXPECT_EQ(found[1].begin, 10);
    EXPECT_EQ(found[1].peak, 20);
    EXPECT_EQ(found[1].end, 26);
    EXPECT_EQ(found[2].end, 30);
}

TEST(Moments, DeathsByOneselfOrTheWorldAreNoKills) {
    const Rules rules = only({.name = "tested", .trigger = Trigger::kill});
    const std::vector<Event> events = {kill(1.0, 0, 0), kill(1.0, nobody, 1), kill(1.0, 1, nobody)};
    EXPECT_TRUE(find_moments(Script(2, 30).footage(), events, rules, test::unit, 0).empty());
}

TEST(Moments, KillsInQuickSuccessionAreAMultiKill) {
    const std::vector<Event> events = {kill(1.0, 0, 1), kill(2.0, 1, 2), kill(3.5, 0, 2), kill(6.4, 0, 1),
                                       kill(9.5, 0, 1)};
    const auto kills = kills_of(events);
    ASSERT_EQ(kills.size(), 5U);
    EXPECT_EQ(kills[0].first, 0U);
    EXPECT_EQ(kills[1].first, 1U);
    EXPECT_EQ(kills[2].first, 0U);
    EXPECT_EQ(kills[3].first, 0U);
    EXPECT_EQ(kills[4].first, 4U);  // 3.1 s later
    const auto found = [&](Beat from) {
        const Rules rules =
            only({.name = "tested", .trigger = Trigger::multi_kill, .before_s = 1.0, .after_s = 0.5});
        return find_moments(Script(3, 120).footage(), events, rules, test::unit, from);
    };
    const auto each = found(0);
    ASSERT_EQ(each.size(), 3U);
    const std::vector<std::pair<Beat, Index>> expected = {{10, 1}, {35, 2}, {64, 1}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto& [peak, victim] = expected[i];
        EXPECT_EQ(each[i].begin, peak - 10);
        EXPECT_EQ(each[i].peak, peak);
        EXPECT_EQ(each[i].end, peak + 6);
        EXPECT_EQ(each[i].actor, 0);
        EXPECT_EQ(each[i].subject, victim);
    }
    ASSERT_EQ(found(50).size(), 1U) << "the others are over";
    EXPECT_EQ(found(50)[0].peak, 64);
}

TEST(Moments, AfterAKillTheKillerIsWorthSeeing) {
    const std::vector<Event> events = {kill(1.0, 0, 1), kill(2.0, 1, 1), kill(2.0, nobody, 1)};
    const auto found =
        find_moments(Script(2, 60).footage(), events,
                     only({.name = "tested", .trigger = Trigger::killer, .after_s = 2.0}), test::unit, 0);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].actor, 0);
    EXPECT_EQ(found[0].subject, nobody);
    EXPECT_EQ(found[0].begin, 10);
    EXPECT_EQ(found[0].end, 31);
}

TEST(Moments, TheLastOfATeamWhoLivesIsAMomentWhileAnEnemyLives) {
    Script script(5, 160);
    for (std::size_t beat = 0; beat < 160; ++beat) {
        for (const std::size_t player : {0U, 1U, 2U})
            script.player(beat, player).team = 1;
        script.player(beat, 3).team = 2;  // a team of one; 4 is everybody's enemy
        script.player(beat, 0).alive = beat < 10;
        script.player(beat, 1).alive = beat < 20 || beat >= 130;
        script.player(beat, 3).alive = script.player(beat, 4).alive = beat < 100;
    }
    const auto found = [&](Beat from) {
        return find_moments(script.footage(), {}, only({.name = "tested", .trigger = Trigger::last_alive}),
                            test::unit, from);
    };
    ASSERT_EQ(found(0).size(), 1U);
    EXPECT_EQ(found(0)[0].actor, 2);
    EXPECT_EQ(found(0)[0].begin, 70) << "5 s after the other's death";
    EXPECT_EQ(found(0)[0].end, 100);
    ASSERT_EQ(found(80).size(), 1U);
    EXPECT_EQ(found(80)[0].begin, 80);
}

TEST(Moments, NobodyIsTheLastWhoLivesWhileTheOthersComeBack) {
    Script script(3, 300);
    for (std::size_t beat = 0; beat < 300; ++beat) {
        script.player(beat, 0).team = script.player(beat, 1).team = 1;
        script.player(beat, 1).alive = beat % 50 >= 40;  // dead for 4 s each time
    }
    EXPECT_TRUE(find_moments(script.footage(), {}, only({.name = "tested", .trigger = Trigger::last_alive}),
                             test::unit, 0)
                    .empty());
}

TEST(Moments, ThatGoOnEndWithWhatIsKnown) {
    Script script(3, 60);
    for (std::size_t beat = 0; beat < 60; ++beat) {
        script.player(beat, 0).team = script.player(beat, 1).team = 1;
        script.player(beat, 1).alive = false;
    }
    const auto found = find_moments(script.footage(), {},
                                    only({.name = "tested", .trigger = Trigger::last_alive}), test::unit, 0);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].begin, 50);
    EXPECT_EQ(found[0].end, 60);
}

TEST(Moments, AWonRoundAndAnEntranceAreOfWhoDidThem) {
    const std::vector<Event> events = {{1.0, EventKind::spawn, 1}, {3.0, EventKind::round_won, 0}};
    for (const auto& [trigger, actor, begin] : {std::tuple(Trigger::spawn, Index{1}, Beat{10}),
                                                std::tuple(Trigger::round_won, Index{0}, Beat{30})}) {
        const auto found = find_moments(Script(2, 60).footage(), events,
                                        only({.name = "tested", .trigger = trigger}), test::unit, 0);
        ASSERT_EQ(found.size(), 1U);
        EXPECT_EQ(found[0].actor, actor);
        EXPECT_EQ(found[0].begin, begin);
    }
}

TEST(Moments, AnExchangeEndsWithItsLastWound) {
    const auto wound = [](double time, Index a, Index b) {
        return Event{time, EventKind::damage, a, b, 10.0};
    };
    const std::vector<Event> events = {wound(1.0, 0, 1), wound(2.0, 1, 0), wound(2.5, 0, 2),
                                       wound(5.0, 0, 1)};
    const auto found =
        find_moments(Script(3, 120).footage(), events,
                     only({.name = "tested", .trigger = Trigger::exchange, .after_s = 1.5}), test::unit, 0);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].begin, 10);
    EXPECT_EQ(found[0].end, 36);  // 2.0 s and 1.5 s more
    EXPECT_EQ(found[1].begin, 25);
    EXPECT_EQ(found[1].subject, 2);
    EXPECT_EQ(found[2].begin, 50);
}

TEST(Moments, AStreakIsThreeKillsInOneLife) {
    const std::vector<Event> events = {kill(1.0, 0, 1), kill(2.0, 0, 1), kill(3.0, 1, 0),     kill(4.0, 0, 1),
                                       kill(5.0, 0, 1), kill(6.0, 0, 1), kill(9.0, nobody, 0)};
    const auto found = find_moments(Script(2, 120).footage(), events,
                                    only({.name = "tested", .trigger = Trigger::streak}), test::unit, 0);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].actor, 0);
    EXPECT_EQ(found[0].begin, 60);
    EXPECT_EQ(found[0].end, 91);
}

TEST(Moments, AFlagRunLastsUntilTheCaptureOrTheCarriersDeath) {
    const auto flag = [](double time, EventKind kind, Index player) { return Event{time, kind, player}; };
    const std::vector<Event> events = {
        flag(1.0, EventKind::flag_taken, 0),    flag(1.5, EventKind::flag_taken, 0),  // touched once more
        flag(2.0, EventKind::flag_taken, 1),    kill(3.0, 0, 1),
        flag(4.0, EventKind::flag_captured, 0), kill(4.5, 1, 0),
        flag(5.0, EventKind::flag_taken, 1)};
    const Rules rules = only({.name = "tested", .trigger = Trigger::flag_run});
    const auto found = find_moments(Script(2, 60).footage(), events, rules, test::unit, 0);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].actor, 0);
    EXPECT_EQ(found[0].begin, 10);
    EXPECT_EQ(found[0].end, 41);
    EXPECT_EQ(found[1].actor, 1);
    EXPECT_EQ(found[1].begin, 20);
    EXPECT_EQ(found[1].end, 31);
    EXPECT_EQ(found[2].actor, 1);
    EXPECT_EQ(found[2].begin, 50);
    EXPECT_EQ(found[2].end, 60) << "it goes on";

    Tally tally;  // of what was forgotten
    for (const Event& event : std::span(events).first(2))
        tally.count(event);
    const auto later =
        find_moments(Script(2, 60).footage(), std::span(events).subspan(3), rules, test::unit, 0, tally);
    ASSERT_EQ(later.size(), 2U);
    EXPECT_EQ(later[0].actor, 0);
    EXPECT_EQ(later[0].begin, 10);
}

TEST(Moments, TheLeadIsWhoseKillsAreMore) {
    const std::vector<Event> events = {kill(1.0, 0, 1), kill(2.0, 1, 0), kill(3.0, 1, 0)};
    const auto found = find_moments(Script(2, 50).footage(), events,
                                    only({.name = "tested", .trigger = Trigger::lead}), test::unit, 0);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].actor, 0);
    EXPECT_EQ(found[0].begin, 10);
    EXPECT_EQ(found[0].end, 31);  // until another has more
    EXPECT_EQ(found[1].actor, 1);
    EXPECT_EQ(found[1].begin, 30);
    EXPECT_EQ(found[1].end, 50);
}

}  // namespace
}  // namespace camdir::direction
