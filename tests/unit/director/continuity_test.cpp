// Respawns and teleports, whatever becomes of the frames that declare them.
#include "director/continuity.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "stage.hpp"
#include "support/eventually.hpp"

namespace camdir::director {
namespace {

using test::eventually;

PlayerPose pose_of(std::uint32_t player, std::optional<std::uint32_t> discontinuities,
                   std::uint32_t flags = pose_alive) {
    PlayerPose pose;
    pose.player_id = player;
    pose.flags = flags;
    pose.discontinuities = discontinuities;
    return pose;
}

TEST(Continuity, IsBrokenByAnotherCountThanThePlayersLast) {
    Continuity continuity;
    EXPECT_FALSE(continuity.broken(pose_of(1, 5))) << "there was no pose before";
    EXPECT_FALSE(continuity.broken(pose_of(2, 0)));
    EXPECT_FALSE(continuity.broken(pose_of(1, 5)));
    EXPECT_TRUE(continuity.broken(pose_of(1, 7)));
    EXPECT_FALSE(continuity.broken(pose_of(1, 7)));
    EXPECT_FALSE(continuity.broken(pose_of(2, 0)));
    continuity.clear();
    EXPECT_FALSE(continuity.broken(pose_of(1, 0)));
}

TEST(Continuity, CountsMayWrapAround) {
    Continuity continuity;
    (void)continuity.broken(pose_of(1, 0xffffffffU));
    EXPECT_TRUE(continuity.broken(pose_of(1, 0)));
}

TEST(Continuity, TheFlagAloneBreaksIt) {
    Continuity continuity;
    EXPECT_TRUE(continuity.broken(pose_of(1, std::nullopt, pose_alive | pose_discontinuity)));
    EXPECT_FALSE(continuity.broken(pose_of(1, std::nullopt)));
    (void)continuity.broken(pose_of(1, 3));
    EXPECT_TRUE(continuity.broken(pose_of(1, 3, pose_alive | pose_discontinuity)));
    EXPECT_FALSE(continuity.broken(pose_of(1, std::nullopt))) << "no count is no other count";
    EXPECT_FALSE(continuity.broken(pose_of(1, 3)));
}

TEST(Continuity, ForgetsRatherThanGrowsWithoutBound) {
    Continuity continuity;
    for (std::uint32_t player = 0; player < Continuity::max_known; ++player)
        EXPECT_FALSE(continuity.broken(pose_of(player, 1)));
    EXPECT_TRUE(continuity.broken(pose_of(0, 2)));
    EXPECT_FALSE(continuity.broken(pose_of(Continuity::max_known, 1))) << "one too many";
    EXPECT_FALSE(continuity.broken(pose_of(0, 3))) << "forgotten";
    EXPECT_TRUE(continuity.broken(pose_of(0, 4)));
}

// A match of players who jump and leave at random, of which any frames are lost.
RC_GTEST_PROP(Continuity, AJumpIsNoticedAtThePlayersNextFrame, ()) {
    Continuity continuity;
    std::map<std::uint32_t, std::uint32_t> counts;
    std::map<std::uint32_t, bool> seen, jumped;
    for (int frame = 0; frame < 200; ++frame) {
        const bool lost = *rc::gen::inRange(0, 3) == 0;
        for (std::uint32_t player = 1; player <= 4; ++player) {
            if (*rc::gen::inRange(0, 4) == 0) continue;  // not in this frame
            const bool jumps = *rc::gen::inRange(0, 5) == 0;
            counts[player] += jumps ? 1 : 0;
            jumped[player] = jumped[player] || jumps;
            if (lost) continue;
            const std::uint32_t flags = pose_alive | (jumps ? pose_discontinuity : 0U);
            const bool expected = jumps || (seen[player] && jumped[player]);
            RC_ASSERT(continuity.broken(pose_of(player, counts[player], flags)) == expected);
            seen[player] = true;
            jumped[player] = false;
        }
    }
}

// Player 1 is somewhere else from frame `since` on.
PoseFrame teleported(std::uint32_t number, std::uint32_t since) {
    PoseFrame frame = Stage::poses(number);
    for (PlayerPose& pose : frame.poses)
        pose.discontinuities = 40;
    if (number < since) return frame;
    frame.poses[0].eye = Vec3f(20.0F, 80.0F, 0.0F);
    frame.poses[0].discontinuities = 41;
    if (number == since) frame.poses[0].flags |= pose_discontinuity;
    return frame;
}

TEST(LostFrames, ATeleportCutsAtTheNextFrame) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    for (std::uint32_t number = 0; number < 20; ++number)
        if (number != 10) stage.send(teleported(number, 10));
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), 19U);
    for (const CameraFrame& frame : frames)
        EXPECT_EQ(cuts(frame), frame.pose_number == 0 || frame.pose_number == 11) << frame.pose_number;
}

TEST(LostFrames, ATeleportCutsOnceWhenItsFrameArrives) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    for (std::uint32_t number = 0; number < 20; ++number)
        stage.send(teleported(number, 10));
    for (const CameraFrame& frame : stage.publisher.frames())
        EXPECT_EQ(cuts(frame), frame.pose_number == 0 || frame.pose_number == 10) << frame.pose_number;
}

TEST(LostFrames, AReturnAfterAnAbsenceCutsIfThePlayerHasTeleported) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    for (std::uint32_t number = 0; number < 20; ++number) {
        PoseFrame frame = teleported(number, 10);
        if (number == 9 || number == 11) frame.poses.erase(frame.poses.begin());
        if (number != 10) stage.send(frame);
    }
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), 19U);
    for (const CameraFrame& frame : frames)
        EXPECT_EQ(cuts(frame), frame.pose_number == 0 || frame.pose_number == 12) << frame.pose_number;
}

TEST(LostFrames, ATeleportCutsInADelayedMatch) {
    Stage stage;
    MatchInfo info = Stage::info();
    info.spectator_delay_s = 0.5F;
    stage.start(info);
    stage.ask(Stage::request("a"));
    for (std::uint32_t number = 0; number < 20; ++number)
        if (number != 10) receive(stage.director, "m", teleported(number, 10));
    ASSERT_TRUE(eventually([&] {
        const auto shown = stage.publisher.frames();
        return !shown.empty() && shown.back().pose_number == 19;
    }));
    // Frames that are due together are shown as one.
    const auto frames = stage.publisher.frames();
    const auto first = std::find_if(frames.begin(), frames.end(),
                                    [](const CameraFrame& frame) { return frame.pose_number > 10; });
    for (const CameraFrame& frame : frames)
        EXPECT_EQ(cuts(frame), &frame == &frames.front() || &frame == &*first) << frame.pose_number;
}

}  // namespace
}  // namespace camdir::director
