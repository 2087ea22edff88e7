#include "direction/grammar.hpp"

#include <gtest/gtest.h>

#include "small_match.hpp"

namespace camdir::direction {
namespace {

using test::Script;

TEST(Grammar, ThePreferredLengthCostsNothingAndOthersBySymmetricRatios) {
    Grammar grammar;
    grammar.preferred_shot_s = 4.0;
    grammar.length = 2.0;
    EXPECT_DOUBLE_EQ(length_cost(grammar, 40), 0.0);
    EXPECT_DOUBLE_EQ(length_cost(grammar, 20), length_cost(grammar, 80));
    EXPECT_NEAR(length_cost(grammar, 80), 2.0 * std::log(2.0) * std::log(2.0), 1e-12);
}

// Two cameras look at player 1, who is at the origin.
Footage two_views(const Vec3f& first, const Vec3f& second) {
    Script script(2, 1);
    script.player(0, 1).eye = Vec3f::Zero();
    script.take(0, 0).position = first;
    script.take(0, 0).shown.set(1);
    script.take(0, 1).position = second;
    return script.footage();
}

TEST(Grammar, AJumpCutSeesTheSamePlayerFromNearlyTheSameSide) {
    const Grammar grammar;  // 30 degrees
    const auto from = [](double degrees) {
        const double angle = degrees * radians_of_a_degree<double>;
        return Vec3f(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F);
    };
    EXPECT_TRUE(jump_cut(two_views(from(0), 3.0F * from(29)), grammar, 0, 0, 1));
    EXPECT_TRUE(jump_cut(two_views(from(0), from(29)), grammar, 0, 1, 0));
    EXPECT_FALSE(jump_cut(two_views(from(0), from(31)), grammar, 0, 0, 1));
}

TEST(Grammar, ACutBetweenPlayersWhoAreNotBothShownIsNoJumpCut) {
    Script script(2, 1);
    script.take(0, 0).position = script.take(0, 1).position;
    EXPECT_FALSE(jump_cut(script.footage(), Grammar{}, 0, 0, 1));
}

TEST(Grammar, WhoIsHiddenMayNotBe) {
    Script script(2, 1);
    script.take(0, 0).position = script.take(0, 1).position;
    EXPECT_FALSE(may_be_jump_cut(script.footage(), Grammar{}, 0, 0, 1));
    for (const std::size_t rush : {0U, 1U})
        script.take(0, rush).framed.set(0);
    EXPECT_FALSE(jump_cut(script.footage(), Grammar{}, 0, 0, 1));
    EXPECT_TRUE(may_be_jump_cut(script.footage(), Grammar{}, 0, 0, 1));
}

TEST(Grammar, WhateverShowsAPlayerOfEitherPictureMayJump) {
    Script script(2, 1, 2);
    for (const std::size_t rush : {2U, 3U}) {
        script.take(0, rush).position = {50.0F, 300.0F, 0.0F};
        script.take(0, rush).shown.set(0).set(1);
    }
    EXPECT_FALSE(jump_cut(script.footage(), Grammar{}, 0, 2, 3));
    script.take(0, 2).subject = 1;
    EXPECT_TRUE(jump_cut(script.footage(), Grammar{}, 0, 2, 3));
    EXPECT_TRUE(jump_cut(script.footage(), Grammar{}, 0, 3, 2));
}

TEST(Grammar, TheLineOfActionJoinsEnemiesInSight) {
    Script script(2, 1);
    script.take(0, 0).position = {-50.0F, 20.0F, 0.0F};
    script.take(0, 1).position = {150.0F, -20.0F, 0.0F};
    EXPECT_FALSE(crosses_line(script.footage(), 0, 0, 1));  // they do not see each other
    EXPECT_TRUE(may_cross_line(script.footage(), 0, 0, 1));
    script.meet(0, 0, 1);
    EXPECT_TRUE(crosses_line(script.footage(), 0, 0, 1));
    EXPECT_TRUE(crosses_line(script.footage(), 0, 1, 0));
    script.player(0, 0).team = script.player(0, 1).team = 2;
    EXPECT_FALSE(crosses_line(script.footage(), 0, 0, 1));
    script.player(0, 0).team = 1;
    script.take(0, 1).position.y() = 20.0F;
    EXPECT_FALSE(crosses_line(script.footage(), 0, 0, 1));
    EXPECT_FALSE(may_cross_line(script.footage(), 0, 0, 1));
}

TEST(Grammar, NearTheLineACutToAFixedCameraMayCrossIt) {
    Script script(2, 1, 1);
    script.take(0, 2).subject = 1;
    script.take(0, 2).position = {50.0F, 300.0F, 0.0F};
    script.meet(0, 0, 1);
    const auto from = [&](double degrees) {
        const double angle = degrees * radians_of_a_degree<double>;
        script.take(0, 0).position =
            script.player(0, 0).eye +
            100.0F * Vec3f(-static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F);
    };
    from(29);
    EXPECT_TRUE(may_cross_line(script.footage(), 0, 0, 2));
    EXPECT_FALSE(crosses_line(script.footage(), 0, 0, 2));
    EXPECT_FALSE(may_cross_line(script.footage(), 0, 2, 0));  // that camera can give way
    from(31);
    EXPECT_FALSE(may_cross_line(script.footage(), 0, 0, 2));
    from(-31);
    EXPECT_TRUE(crosses_line(script.footage(), 0, 0, 2));
}

TEST(Grammar, ACutNextToAJumpOfACameraLeavesAFragment) {
    Script script(2, 60);
    script.take(20, 0).cut = true;
    const Footage footage = script.footage();
    EXPECT_FALSE(jumped_just_before(footage, 20, 0));
    EXPECT_TRUE(jumped_just_before(footage, 21, 0));
    EXPECT_TRUE(jumped_just_before(footage, 34, 0));
    EXPECT_FALSE(jumped_just_before(footage, 35, 0));
    EXPECT_FALSE(jumps_soon_after(footage, 5, 0));
    EXPECT_TRUE(jumps_soon_after(footage, 6, 0));
    EXPECT_TRUE(jumps_soon_after(footage, 19, 0));
    EXPECT_FALSE(jumps_soon_after(footage, 20, 0));
    EXPECT_FALSE(jumped_just_before(footage, 21, 1) || jumps_soon_after(footage, 6, 1));
}

TEST(Grammar, ACutInTheBeatOfALaterJumpLeavesAFragment) {
    Script script(2, 60);
    script.take(20, 0).jump(false);
    const Footage footage = script.footage();
    EXPECT_TRUE(jumps_soon_after(footage, 20, 0));
    EXPECT_FALSE(jumps_soon_after(footage, 21, 0));
    EXPECT_TRUE(jumped_just_before(footage, 21, 0));
    EXPECT_FALSE(jumps_soon_after(footage, 60, 0));  // not known yet
}

TEST(Grammar, WhoStandsForTwoSecondsWithoutAnEnemyIsIdle) {
    Script script(2, 40);
    for (std::size_t beat = 10; beat < 40; ++beat)
        script.player(beat, 0).speed = 0.0F;
    script.meet(35, 0, 1);
    const Footage footage = script.footage();
    EXPECT_FALSE(stands_idle(footage, 28, 0, 32.0));
    EXPECT_TRUE(stands_idle(footage, 29, 0, 32.0));
    EXPECT_FALSE(stands_idle(footage, 35, 0, 32.0));
    EXPECT_TRUE(stands_idle(footage, 36, 0, 32.0));
    EXPECT_FALSE(stands_idle(footage, 36, 1, 32.0));
}

}  // namespace
}  // namespace camdir::direction
