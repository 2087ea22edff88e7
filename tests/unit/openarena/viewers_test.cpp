// What a spectator is shown.
#include "viewers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "viewers_fixture.hpp"

namespace camdir::openarena {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(OpenArenaViewers, WhoSpectatesGetsTheDirectorsCamera) {
    EXPECT_EQ(game.request(viewer).active, 1);
    EXPECT_EQ(game.request(viewer).mode, viewer_auto);
    EXPECT_EQ(game.request(anna).active, 0);
    EXPECT_TRUE(flies_freely()) << "no camera yet";
    watch(anna, 1);
    EXPECT_TRUE(game.shows_camera(viewer));
    EXPECT_THAT(shown_position(), ElementsAre(5, 0, 50));
}

TEST_F(OpenArenaViewers, TheGameNeverSeesTheOverlay) {
    watch(anna, 1, 3);
    game.call([&] {
        EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
        game.call([&] { EXPECT_EQ(game.snapshot(viewer), game.own(viewer)) << "in a nested call"; });
        EXPECT_EQ(game.snapshot(viewer), game.own(viewer)) << "after a nested call";
    });
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer)) << "nothing is sent before the next frame";
    game.run_frame();
    EXPECT_TRUE(game.shows_camera(viewer));
}

TEST_F(OpenArenaViewers, PlayersAreNeverTouched) {
    game.connect_spectator(5, "Dan");
    game.join_team(5, team_red);
    for (std::uint32_t i = 0; i < 5; ++i) {
        for (int slot = 0; slot < 8; ++slot)
            game.set_camera(slot, anna, i, 10);
        game.run_frame();
        for (const int slot : {anna, bob, 5})
            EXPECT_EQ(game.snapshot(slot), game.own(slot));
        EXPECT_EQ(game.request(5).active, 0);
    }
}

TEST_F(OpenArenaViewers, TheCameraIsPredictedFromItsTwoNewestFrames) {
    watch(anna, 1, 3);
    EXPECT_THAT(shown_position(), ElementsAre(17.5F, 0, 50))
        << "15 of the frame before, and half a step of 5";
}

TEST_F(OpenArenaViewers, TheGamesOwnViewFollowsTheDirectorsTarget) {
    watch(anna, 1, 3);
    EXPECT_TRUE(follows(anna));
    watch(bob, 2, 3);
    EXPECT_TRUE(follows(bob));
    EXPECT_EQ(game.request(viewer).mode, viewer_auto) << "not mistaken for the viewer's choice";
}

TEST_F(OpenArenaViewers, WithoutCamerasTheGamesOwnViewIsSeen) {
    watch(anna, 1, 3);
    const std::uint64_t fallbacks = viewers_counters()->fallbacks;
    for (int age = 100; age <= 250; age += 50) {
        game.run_frame();
        EXPECT_TRUE(game.shows_camera(viewer)) << age;
    }
    game.run_frame();
    EXPECT_FALSE(game.shows_camera(viewer));
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
    EXPECT_TRUE(follows(anna)) << "the same player";
    EXPECT_EQ(viewers_counters()->fallbacks, fallbacks + 1);
    EXPECT_EQ(game.request(viewer).active, 1);
    const int bit = game.teleport_bit(viewer);
    watch(anna, 1);
    EXPECT_FALSE(game.shows_camera(viewer)) << "not before 100 ms";
    watch(anna, 1);
    EXPECT_TRUE(game.shows_camera(viewer));
    EXPECT_NE(game.teleport_bit(viewer), bit);
}

TEST_F(OpenArenaViewers, ReportsOfAnotherLifeAreIgnored) {
    game.report.life = 2;
    watch(anna, 1, 2);
    EXPECT_FALSE(game.shows_camera(viewer));
    game.has_report = false;
    watch(anna, 1, 2);
    EXPECT_FALSE(game.shows_camera(viewer));
}

TEST_F(OpenArenaViewers, TheGamesOwnFollowChoosesThePlayer) {
    watch(anna, 1, 3);
    game.follow(viewer, bob);
    watch(anna, 1);
    EXPECT_EQ(game.request(viewer).mode, viewer_follow);
    EXPECT_EQ(game.request(viewer).target, bob);
    EXPECT_TRUE(game.shows_camera(viewer)) << "the old shot until the new one comes";
    watch(bob, 2, 30);
    EXPECT_EQ(game.request(viewer).target, bob);
    EXPECT_TRUE(game.client_command(viewer, {"director", "auto"}));
    watch(anna, 3, 3);
    EXPECT_EQ(game.request(viewer).mode, viewer_auto);
    EXPECT_TRUE(follows(anna));
}

TEST_F(OpenArenaViewers, ThePlayerThatTheDirectorShowsCanBeChosen) {
    watch(anna, 1, 3);
    EXPECT_FALSE(game.client_command(viewer, {"follow", "0"})) << "the game has it, too";
    watch(anna, 1);
    EXPECT_EQ(game.request(viewer).mode, viewer_follow);
    EXPECT_EQ(game.request(viewer).target, anna);
}

TEST_F(OpenArenaViewers, FreeFlightIsHandedBackWhereItWas) {
    const std::array<float, 3> place = {-800, 300, 64}, angles = {12, -95, 0};
    write_vector(game.state(viewer), PS_ORIGIN, place.data());
    write_vector(game.state(viewer), PS_VIEW_ANGLES, angles.data());
    game.run_frame();
    const auto stop = [&](const std::string& how) {
        if (how == "kick") game.disconnect(anna);
        if (how == "off") game.client_command(viewer, {"director", "off"});
        if (how == "stop") game.call([&] { game.stop_following(viewer); });
        if (how == "disabled") {
            game.client_command(viewer, {"director", "auto"});  // not the viewer's choice of a player
            game.options.spectate = 0;
        }
    };
    for (const std::string how : {"off", "stop", "disabled", "kick"}) {
        SCOPED_TRACE(how);
        watch(anna, 1, 3);
        game.follow(viewer, anna);
        game.client_command(viewer, {"follow", "0"});  // so that the loss of the player is the end
        watch(anna, 1, 3);
        ASSERT_TRUE(game.shows_camera(viewer));
        const int bit = game.teleport_bit(viewer);
        game.user_angles[viewer] = {1000, 70000, 0};  // the mouse has moved meanwhile
        stop(how);
        watch(anna, 1);
        EXPECT_TRUE(flies_freely());
        EXPECT_EQ(vector(PS_ORIGIN), place);
        EXPECT_EQ(vector(PS_VIEW_ANGLES), angles);
        EXPECT_NE(game.teleport_bit(viewer), bit);
        for (std::size_t i = 0; i < 3; ++i) {
            const int sum =
                read_element(game.state(viewer), PS_DELTA_ANGLES, i) + game.user_angles[viewer][i];
            EXPECT_NEAR(std::remainder(sum * 360.0 / 65536 - angles[i], 360.0), 0, 0.006);
        }
        game.options.spectate = 1;
        game.client_command(viewer, {"director", "auto"});
    }
}

TEST_F(OpenArenaViewers, OffIsTheGamesOwnSpectating) {
    watch(anna, 1, 3);
    EXPECT_TRUE(game.client_command(viewer, {"director", "off"}));
    watch(anna, 1, 30);
    EXPECT_EQ(game.request(viewer).active, 0);
    game.follow(viewer, bob);
    for (int i = 0; i < 30; ++i) {
        watch(anna, 1);
        EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
        EXPECT_TRUE(follows(bob));
    }
}

TEST_F(OpenArenaViewers, APlayersStateIsTheGamesOwnFromTheSpawnOn) {
    watch(anna, 1, 3);
    State spawned{};
    game.call([&] {
        game.join_team(viewer, team_free);
        spawned = game.snapshot(viewer);
        game.change_name(viewer, "Eva");
        game.change_name(viewer, "Eve");
    });
    watch(anna, 1, 1);
    EXPECT_EQ(game.snapshot(viewer), spawned);
}

TEST_F(OpenArenaViewers, ACameraOfTheFutureDoesNotKeepOutTheNextOnes) {
    watch(anna, 1, 3);
    game.set_camera(viewer, anna, 1, x += 5);
    game.report.cameras[viewer].level_time += 1'000'000;
    game.run_frame();
    watch(anna, 1, 10);
    EXPECT_TRUE(game.shows_camera(viewer));
}

TEST_F(OpenArenaViewers, IntermissionsAreLeftAlone) {
    watch(anna, 1, 3);
    game.begin_intermission();
    for (int i = 0; i < 30; ++i) {
        watch(anna, 1);
        EXPECT_EQ(read_int(game.state(viewer), PS_PM_TYPE), PM_INTERMISSION);
    }
    EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
    EXPECT_EQ(game.request(viewer).mode, viewer_auto);
}

TEST_F(OpenArenaViewers, TheTargetsNameIsShownAndUndone) {
    const std::string shows_anna = "cs 548 \"n\\Anna\\t\\3\\model\\sarge\"\n";
    const std::string shows_bob = "cs 548 \"n\\Bob\\t\\3\\model\\sarge\"\n";
    const std::string shows_eve = "cs 548 \"n\\Eve\\t\\3\\model\\sarge\"\n";
    const auto sent = [&] {
        auto texts = game.sent_to(viewer);
        texts.erase(
            std::remove_if(texts.begin(), texts.end(), [](auto& t) { return t.rfind("cs ", 0) != 0; }),
            texts.end());
        game.forget_sent();
        return texts;
    };
    watch(anna, 1, 30);
    EXPECT_THAT(sent(), ElementsAre(shows_anna));
    watch(bob, 2, 1);
    EXPECT_THAT(sent(), ElementsAre(shows_bob));
    watch(anna, 3, 1);
    watch(bob, 4, 1);
    EXPECT_THAT(sent(), IsEmpty()) << "at most two a second";
    watch(anna, 5, 30);
    EXPECT_THAT(sent(), ElementsAre(shows_anna));
    game.change_name(viewer, "Eve");
    game.run_frame();
    watch(anna, 5, 15);
    EXPECT_THAT(sent(), ElementsAre(shows_anna)) << "the engine may have sent the own name";
    game.client_command(viewer, {"director", "off"});
    watch(anna, 5, 15);
    EXPECT_THAT(sent(), ElementsAre(shows_eve));
    EXPECT_EQ(game.configstring(548), "n\\Eve\\t\\3\\model\\sarge") << "nobody else sees another name";
}

TEST_F(OpenArenaViewers, EachHasAShotOfTheirOwn) {
    game.connect_spectator(5, "Dan");
    for (int i = 0; i < 5; ++i) {
        game.set_camera(5, bob, 7, 1000);
        watch(anna, 1);
    }
    float other[3];
    read_vector(other, game.state(5), PS_ORIGIN);
    EXPECT_EQ(other[0], 1000);
    EXPECT_NE(shown_position()[0], 1000);
    EXPECT_TRUE(game.shows_camera(viewer) && game.shows_camera(5));
}

}  // namespace
}  // namespace camdir::openarena
