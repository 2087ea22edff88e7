// Clients that come, leave and change sides, and changes of the map, while cameras are shown.
#include "viewers.h"

#include <gtest/gtest.h>

#include <limits>

#include "viewers_fixture.hpp"

namespace camdir::openarena {
namespace {

// The engine drops clients that timed out after the frame and before it sends the snapshots.
TEST_F(OpenArenaViewers, TheCameraStaysWhileOthersAreDropped) {
    watch(anna, 1, 3);
    const State camera = game.snapshot(viewer);
    game.disconnect(bob);
    EXPECT_EQ(game.snapshot(viewer), camera);
}

TEST_F(OpenArenaViewers, AViewerWhoJoinsATeamIsAPlayerAtOnce) {
    watch(anna, 1, 3);
    game.join_team(viewer, team_free);
    const State before = game.snapshot(viewer);
    EXPECT_EQ(read_int(before.data(), PS_PM_TYPE), PM_NORMAL) << "even before the next frame";
    game.run_frame();
    EXPECT_FALSE(game.shows_camera(viewer));
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
    game.join_team(viewer, team_spectator);
    watch(anna, 2, 4);
    EXPECT_TRUE(game.shows_camera(viewer));
}

TEST_F(OpenArenaViewers, WhenThePlayerLeavesTheDirectorChoosesAnother) {
    watch(anna, 1, 3);
    game.disconnect(anna);
    watch(anna, 1);
    EXPECT_TRUE(game.shows_camera(viewer));
    EXPECT_EQ(game.request(viewer).mode, viewer_auto);
    watch(bob, 2, 2);
    EXPECT_TRUE(follows(bob));
}

TEST_F(OpenArenaViewers, ASlotIsReusedWithinOneFrame) {
    game.client_command(viewer, {"director", "profile", "wide"});
    watch(anna, 1, 3);
    game.client_command(viewer, {"follow", "1"});
    game.call([&] {
        game.disconnect(viewer);
        game.connect_spectator(viewer, "Dan");
    });
    watch(anna, 1);
    EXPECT_TRUE(flies_freely());
    EXPECT_EQ(game.request(viewer).mode, viewer_auto);
    EXPECT_STREQ(game.request(viewer).profile, "");
    EXPECT_EQ(vector(PS_ORIGIN)[0], 400) << "where the game spawned them";
    watch(anna, 1, 3);
    EXPECT_TRUE(game.shows_camera(viewer));
    game.call([&] {
        game.disconnect(viewer);
        game.connect_bot(viewer, "Bot");
    });
    watch(anna, 1);
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
    EXPECT_EQ(game.request(viewer).active, 0);
}

TEST_F(OpenArenaViewers, ClientsDropInMidFrame) {
    watch(anna, 1, 3);
    game.in_next_frame([&] { game.disconnect(anna); });
    watch(anna, 1);
    EXPECT_TRUE(game.shows_camera(viewer)) << "the old shot until the new one comes";
    EXPECT_EQ(game.request(viewer).mode, viewer_auto);
    game.in_next_frame([&] { game.disconnect(viewer); });
    watch(bob, 2);
    EXPECT_EQ(game.request(viewer).active, 0);
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
    game.call([&] { game.disconnect(viewer); });  // once more
    watch(bob, 2);
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
}

TEST_F(OpenArenaViewers, AKickedViewerLeavesNothingBehind) {
    watch(anna, 1, 3);
    const State bots[] = {game.snapshot(anna), game.snapshot(bob)};
    game.console_command({"director", "profile", "wide", "4"});
    game.disconnect(viewer);
    watch(anna, 1, 3);
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
    EXPECT_EQ(game.snapshot(anna), bots[0]);
    EXPECT_EQ(game.snapshot(bob), bots[1]);
    viewer_status status{};
    EXPECT_FALSE(viewers_status(viewer, &status));
}

TEST_F(OpenArenaViewers, ARestartWhileACameraIsShown) {
    for (const bool same_map : {true, false}) {
        watch(anna, 1, 5);
        ASSERT_TRUE(game.shows_camera(viewer));
        const director_report stale = game.report;
        game.restart(same_map);
        EXPECT_EQ(read_int(game.state(viewer), PS_CLIENT_NUMBER), viewer);
        EXPECT_FALSE(game.shows_camera(viewer));
        for (int i = 0; i < 6; ++i) {
            game.report = stale;  // level times that are over, or in the future
            game.run_frame();
            EXPECT_FALSE(game.shows_camera(viewer)) << i;
            EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
        }
        EXPECT_EQ(game.request(viewer).mode, viewer_auto);
    }
}

TEST_F(OpenArenaViewers, TheCameraComesAndGoesWithTheSetting) {
    watch(anna, 1, 3);
    for (int i = 0; i < 20; ++i) {
        const State sent = game.snapshot(viewer);
        const bool camera = game.shows_camera(viewer);
        game.options.spectate ^= 1;
        watch(anna, 1, i % 4 + 1);
        EXPECT_FALSE(camera && i % 4 == 0 && blends(sent, game.snapshot(viewer)));
        EXPECT_EQ(game.request(viewer).active, game.options.spectate);
        EXPECT_TRUE(game.options.spectate != 0 || flies_freely());
    }
}

TEST_F(OpenArenaViewers, LevelTimesUpToTheLargest) {
    game.level_time = std::numeric_limits<std::int32_t>::max() - 2000;
    game.run_frame();
    watch(anna, 1, 30);
    EXPECT_TRUE(game.shows_camera(viewer));
    EXPECT_TRUE(follows(anna));
    game.restart(false);
    watch(bob, 2, 5);
    EXPECT_TRUE(game.shows_camera(viewer)) << "of the new life, whose time is small";
    EXPECT_TRUE(follows(bob));
}

TEST_F(OpenArenaViewers, ChoicesOutliveAMapButNotAConnection) {
    game.client_command(viewer, {"director", "off"});
    game.client_command(viewer, {"director", "profile", "wide"});
    game.restart(false);
    game.run_frame();
    EXPECT_EQ(game.request(viewer).active, 0);
    game.client_command(viewer, {"director", "auto"});
    game.run_frame();
    EXPECT_STREQ(game.request(viewer).profile, "wide");
    game.disconnect(viewer);
    game.options.profile[0] = 'd';
    game.connect_spectator(viewer, "Dan");
    game.run_frame();
    EXPECT_EQ(game.request(viewer).active, 1);
    EXPECT_STREQ(game.request(viewer).profile, "d");
    EXPECT_FALSE(game.shows_camera(viewer));
}

TEST_F(OpenArenaViewers, ASlotsNextClientInheritsNothing) {
    watch(anna, 1, 3);
    game.disconnect(viewer);
    game.connect_bot(viewer, "Bot");
    watch(anna, 1, 3);
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
    game.disconnect(viewer);
    game.connect_spectator(viewer, "Dan");
    game.run_frame();
    EXPECT_TRUE(flies_freely());
    EXPECT_EQ(game.request(viewer).mode, viewer_auto);
}

}  // namespace
}  // namespace camdir::openarena
