#include "direction/programme.hpp"

#include <gtest/gtest.h>

#include "direction/figures.hpp"
#include "small_match.hpp"

namespace camdir::direction {
namespace {

using test::random_kills;
using test::random_script;

constexpr std::size_t players = 4;
constexpr std::size_t beats = 150;

std::vector<Shot> directed(const Footage& footage, std::span<const Event> events, double delay_s) {
    return direct(footage, events, default_rules(), test::unit, delay_s, {}).value();
}

// The same, by an editor who keeps all that is known.
std::vector<Shot> directed_without_forgetting(const Footage& footage, std::span<const Event> events,
                                              double delay_s) {
    const Rules rules = default_rules();
    Footage known(footage.players(), footage.followed());
    OnAir on_air{{}, std::vector<Beat>(footage.rushes(), never_shown)};
    std::vector<Shot> shots;
    for (Beat now = 0; now < footage.beats(); now += cut_every) {
        while (known.beats() < std::min(now + beat_of(delay_s), footage.beats()))
            known.append(footage.players_at(known.beats()), footage.takes_at(known.beats()));
        const auto after =
            std::ranges::lower_bound(events, static_cast<double>(known.beats()) * beat_s, {}, &Event::time);
        const auto moments =
            find_moments(known, {events.begin(), after}, rules, test::unit, std::max<Beat>(0, now - 20));
        const Shot next = plan_shots(known, moments, rules, test::unit, on_air, now).front();
        on_air.last_shown[next.rush] = now;
        if (on_air.shot && on_air.shot->rush == next.rush) continue;
        if (!shots.empty()) shots.back().end = now;
        shots.push_back({next.rush, now, now, next.reason});
        on_air.shot = shots.back();
    }
    shots.back().end = footage.beats();
    return shots;
}

class Programme : public testing::TestWithParam<double> {};

TEST_P(Programme, CoversTheMatchWithShotsThatAreLongEnough) {
    std::mt19937 random(1);
    for (int round = 0; round < 5; ++round) {
        const Footage footage = random_script(players, beats, random).footage();
        const auto shots = directed(footage, random_kills(players, 15.0, 10, random), GetParam());
        EXPECT_EQ(shots.front().begin, 0);
        EXPECT_EQ(shots.back().end, static_cast<Beat>(beats));
        for (std::size_t i = 0; i + 1 < shots.size(); ++i) {
            EXPECT_EQ(shots[i].end, shots[i + 1].begin);
            EXPECT_NE(shots[i].rush, shots[i + 1].rush);
            EXPECT_GE(shots[i].end - shots[i].begin, beat_of(Grammar().minimum_shot_s));
        }
    }
}

// Whatever happens after a moment that the audience has not seen does not change what it was shown.
TEST_P(Programme, KnowsNoMoreThanTheDelay) {
    std::mt19937 random(2);
    for (int round = 0; round < 5; ++round) {
        auto script = random_script(players, beats, random);
        auto events = random_kills(players, 15.0, 10, random);
        const auto shots = directed(script.footage(), events, GetParam());
        const std::size_t changed = 90;
        const auto other = random_script(players, beats, random);
        const Footage foreign = other.footage();
        for (std::size_t beat = changed; beat < beats; ++beat)
            for (std::size_t i = 0; i < players; ++i) {
                script.player(beat, i) = foreign.player(static_cast<Beat>(beat), i);
                script.take(beat, i) = foreign.take(static_cast<Beat>(beat), i);
            }
        std::erase_if(events, [](const Event& event) { return event.time >= 9.0; });
        const auto again = directed(script.footage(), events, GetParam());
        const Beat last = static_cast<Beat>(changed) - beat_of(GetParam());  // that knew nothing of it
        for (std::size_t i = 0; i < shots.size() && shots[i].begin <= last; ++i) {
            ASSERT_LT(i, again.size());
            EXPECT_EQ(shots[i].rush, again[i].rush);
            EXPECT_EQ(shots[i].begin, again[i].begin);
        }
    }
}

TEST_P(Programme, WhatIsForgottenIsNotNeeded) {
    std::mt19937 random(4);
    constexpr std::size_t long_match = 1500;
    const Footage footage = random_script(players, long_match, random).footage();
    const auto events = random_kills(players, 150.0, 120, random);
    const auto shots = directed(footage, events, GetParam());
    const auto expected = directed_without_forgetting(footage, events, GetParam());
    ASSERT_EQ(shots.size(), expected.size());
    for (std::size_t i = 0; i < shots.size(); ++i) {
        EXPECT_EQ(shots[i].rush, expected[i].rush);
        EXPECT_EQ(shots[i].begin, expected[i].begin);
        EXPECT_EQ(shots[i].end, expected[i].end);
        EXPECT_EQ(shots[i].reason.why, expected[i].reason.why);
        EXPECT_EQ(shots[i].reason.rule, expected[i].reason.rule);
        EXPECT_EQ(shots[i].reason.actor, expected[i].reason.actor);
        EXPECT_EQ(shots[i].reason.subject, expected[i].reason.subject);
    }
}

INSTANTIATE_TEST_SUITE_P(Delays, Programme, testing::Values(0.0, 1.0, 5.0));

// Fixed rushes begin in even seconds alone, and end with them.
TEST(Programme, ShowsOnlyWhatItMay) {
    const MayShow may_show = [](std::size_t rush, Beat now, bool on_air) {
        return rush < players || (now / 10 % 2 == 0 && (on_air || now % 10 < 5));
    };
    const auto violations = [&](const std::vector<Shot>& shots) {
        std::size_t count = 0;
        for (const Shot& shot : shots)
            for (Beat beat = shot.begin; beat < shot.end; beat += cut_every)
                count += may_show(shot.rush, beat, beat > shot.begin) ? 0 : 1;
        return count;
    };
    std::mt19937 random(7);
    std::size_t fixed = 0, otherwise = 0;
    for (int round = 0; round < 10; ++round) {
        const Footage footage = random_script(players, beats, random, 3).footage();
        const auto events = random_kills(players, 15.0, 10, random);
        const auto shots = direct(footage, events, default_rules(), test::unit, 5.0, {}, may_show).value();
        EXPECT_EQ(violations(shots), 0U);
        fixed += static_cast<std::size_t>(
            std::ranges::count_if(shots, [](const Shot& shot) { return shot.rush >= players; }));
        otherwise += violations(directed(footage, events, 5.0));
    }
    EXPECT_GT(fixed, 0U);
    EXPECT_GT(otherwise, 0U);
}

TEST(Programme, ForKillsSeesAtLeastWhatTheEditorSees) {
    std::mt19937 random(3);
    const Rules rules = default_rules();
    for (int round = 0; round < 10; ++round) {
        const Footage footage = random_script(players, beats, random).footage();
        const auto events = random_kills(players, 15.0, 6, random);
        const auto seen = [&](const std::vector<Shot>& shots) {
            const Figures figures = judge(footage, events, {}, shots, rules.grammar, test::unit);
            return figures.missed_by_cut + figures.jump_cuts + figures.line_crossings > 0.0
                       ? 0.0
                       : figures.kills_seen;
        };
        EXPECT_GE(seen(direct_for_kills(footage, events, rules, test::unit)),
                  seen(directed(footage, events, 15.0)));
    }
}

// 0 kills twice before there is a second to be seen, and once where the match ends; 1 kills where it counts.
TEST(Programme, ForKillsWantsThoseThatCountWhateverTheRulesSay) {
    const Footage footage = test::Script(4, 30).footage();
    const std::vector<Event> events = {test::kill(0.1, 0, 2), test::kill(0.2, 0, 2), test::kill(1.4, 1, 3),
                                       test::kill(2.9, 0, 2)};
    Rules rules = default_rules();
    const auto seen = [&] {
        return judge(footage, events, {}, direct_for_kills(footage, events, rules, test::unit), rules.grammar,
                     test::unit)
            .kills_seen;
    };
    EXPECT_EQ(seen(), 1.0);
    rules.moments.clear();
    EXPECT_EQ(seen(), 1.0);
}

TEST(Programme, StopsWhenAsked) {
    std::stop_source source;
    source.request_stop();
    const Footage footage = test::Script(2, 10).footage();
    const auto stopped = direct(footage, {}, default_rules(), test::unit, 1.0, source.get_token());
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
}

TEST(Programme, NeedsPlayersAndTime) {
    EXPECT_FALSE(direct(Footage(0, {}), {}, default_rules(), test::unit, 1.0, {}));
    EXPECT_FALSE(direct(Footage(1, test::following(1)), {}, default_rules(), test::unit, 1.0, {}));
}

}  // namespace
}  // namespace camdir::direction
