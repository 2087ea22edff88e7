#include "direction/baselines.hpp"

#include <gtest/gtest.h>

#include "small_match.hpp"

namespace camdir::direction {
namespace {

using test::kill;
using test::Script;

void expect_whole(const std::vector<Shot>& shots, Beat beats) {
    ASSERT_FALSE(shots.empty());
    EXPECT_EQ(shots.front().begin, 0);
    EXPECT_EQ(shots.back().end, beats);
    for (std::size_t i = 0; i + 1 < shots.size(); ++i)
        EXPECT_EQ(shots[i].end, shots[i + 1].begin);
}

TEST(Baselines, TheRandomOneSwitchesEverySixSeconds) {
    const auto shots = random_switch(Script(4, 200).footage(), 7);
    expect_whole(shots, 200);
    ASSERT_EQ(shots.size(), 4U);
    EXPECT_EQ(shots[0].end, 60);
    EXPECT_EQ(shots[1].end, 120);
}

TEST(Baselines, HltvLooksAheadOnlyWithItsDelay) {
    Script script(4, 200);
    const std::vector<Event> events = {kill(3.0, 2, 3)};
    const auto ahead = hltv(script.footage(), events, 1.0, 10.0);
    expect_whole(ahead, 200);
    EXPECT_EQ(ahead.front().rush, 2U);
    EXPECT_EQ(ahead.front().end, 50);  // 2 s after the kill
    EXPECT_EQ(hltv(script.footage(), events, 1.0, 9.0).front().rush, 0U);
}

TEST(Baselines, HltvFollowsNobodyWhoKillsThemselves) {
    const std::vector<Event> events = {kill(3.0, 2, 2), kill(3.1, nobody, 1)};
    EXPECT_EQ(hltv(Script(4, 200).footage(), events, 1.0, 10.0).front().rush, 0U);
}

TEST(Baselines, HltvRanksByWhoSeesMost) {
    Script script(3, 100);
    for (std::size_t beat = 0; beat < 100; ++beat) {
        script.meet(beat, 1, 2);
        script.player(beat, 2).facing = -Vec3f::UnitX();
        script.player(beat, 1).facing = Vec3f::UnitY();
    }
    EXPECT_EQ(hltv(script.footage(), {}, 1.0, 0.0).front().rush, 2U);
}

TEST(Baselines, QuakeWorldLeavesTheDeadAfterTwoSeconds) {
    Script script(3, 200);
    for (std::size_t beat = 50; beat < 120; ++beat)
        script.player(beat, 1).alive = false;
    const std::vector<Event> events = {kill(1.0, 1, 0), kill(5.0, 0, 1), kill(5.1, 1, 2)};
    const auto shots = quakeworld(script.footage(), events);
    expect_whole(shots, 200);
    ASSERT_GE(shots.size(), 3U);
    EXPECT_EQ(shots[1].rush, 1U);
    EXPECT_EQ(shots[1].begin, 15);
    EXPECT_EQ(shots[1].end, 70);
    EXPECT_EQ(shots[2].rush, 0U);
}

}  // namespace
}  // namespace camdir::direction
