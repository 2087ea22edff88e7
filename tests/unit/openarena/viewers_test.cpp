#include "viewers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "fake_server.hpp"

namespace camdir::openarena {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr int viewer = 4, anna = 0, bob = 1;

class OpenArenaViewers : public testing::Test {
  protected:
    OpenArenaViewers() {
        game.connect_bot(anna, "Anna");
        game.connect_bot(bob, "Bob");
        game.connect_spectator(viewer, "Eve");
        for (int i = 0; i < 3; ++i)
            game.run_frame();
    }

    // Frames with a camera that is one frame late, as live.
    void watch(int target, std::uint32_t segment, int frames = 1) {
        for (int i = 0; i < frames; ++i) {
            game.set_camera(viewer, target, segment, x += 5);
            game.run_frame();
        }
    }
    std::array<float, 3> shown_position() {
        std::array<float, 3> result = vector(PS_ORIGIN);
        result[2] += static_cast<float>(read_int(game.state(viewer), PS_VIEW_HEIGHT));
        return result;
    }
    std::array<float, 3> vector(std::size_t offset) {
        std::array<float, 3> result;
        read_vector(result.data(), game.state(viewer), offset);
        return result;
    }
    bool follows(int target) {
        const State own = game.own(viewer);
        return (read_int(own.data(), PS_PM_FLAGS) & PM_FLAG_FOLLOW) != 0 &&
               read_int(own.data(), PS_CLIENT_NUMBER) == target;
    }
    bool flies_freely() {
        return !game.shows_camera(viewer) && read_int(game.state(viewer), PS_PM_TYPE) == PM_SPECTATOR &&
               read_int(game.state(viewer), PS_PM_FLAGS) == 0;
    }

    FakeServer game;
    float x = 0;
};

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

// The engine drops clients that timed out after the frame and before it sends the snapshots.
TEST_F(OpenArenaViewers, TheCameraStaysWhileOthersAreDropped) {
    watch(anna, 1, 3);
    const State camera = game.snapshot(viewer);
    game.disconnect(bob);
    EXPECT_EQ(game.snapshot(viewer), camera);
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

TEST_F(OpenArenaViewers, TheCameraIsPredictedFromItsTwoNewestFrames) {
    watch(anna, 1, 3);
    EXPECT_THAT(shown_position(), ElementsAre(17.5F, 0, 50))
        << "15 of the frame before, and half a step of 5";
}

TEST_F(OpenArenaViewers, TheTeleportBitTogglesExactlyAtSegments) {
    watch(anna, 1);
    int bit = game.teleport_bit(viewer);
    for (const std::uint32_t segment : {1, 1, 2, 2, 2, 9, 3, 3}) {
        const bool cut = segment != game.report.cameras[viewer].segment;
        watch(anna, segment);
        EXPECT_EQ(game.teleport_bit(viewer) != bit, cut) << segment;
        bit = game.teleport_bit(viewer);
    }
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

TEST_F(OpenArenaViewers, WhenThePlayerLeavesTheDirectorChoosesAnother) {
    watch(anna, 1, 3);
    game.disconnect(anna);
    watch(anna, 1);
    EXPECT_TRUE(game.shows_camera(viewer));
    EXPECT_EQ(game.request(viewer).mode, viewer_auto);
    watch(bob, 2, 2);
    EXPECT_TRUE(follows(bob));
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

// A client blends two snapshots in a row of one client number and teleport bit.
bool blends(const State& before, const State& after) {
    const int changed = read_int(before.data(), PS_EFLAGS) ^ read_int(after.data(), PS_EFLAGS);
    return (changed & EFLAG_TELEPORT) == 0 &&
           read_int(before.data(), PS_CLIENT_NUMBER) == read_int(after.data(), PS_CLIENT_NUMBER);
}

TEST_F(OpenArenaViewers, JoiningATeamIsACutForTheClient) {
    const auto join = [&](const std::string& how) {
        if (how == "command") game.client_command(viewer, {"team", "f"});
        if (how == "console") game.join_team(viewer, team_red);
        if (how == "game") game.in_next_frame([&] { game.join_team(viewer, team_free); });
        if (how == "name") {
            game.change_name(viewer, "Eva");
            game.join_team(viewer, team_free);
            game.change_name(viewer, "Eve");
        }
        game.run_frame();
    };
    std::uint32_t segment = 1;
    for (const std::string how : {"command", "console", "game", "name"}) {
        for (int state = 0; state < 64; ++state) {
            SCOPED_TRACE(how + ", " + std::to_string(state));
            game.join_team(viewer, team_spectator);
            game.client_command(viewer, {"director", "auto"});
            for (int i = 0; i < 4; ++i)
                watch(state & 1 ? anna : bob, ++segment);
            if (state & 2) game.client_command(viewer, {"follow", "0"});
            if (state & 4) game.respawn(anna);
            if (state & 8) watch(anna, segment);
            if (state & 16) watch(anna, ++segment);
            if (state & 32) game.respawn(bob);
            const State sent = game.sent(viewer);
            ASSERT_EQ(read_int(sent.data(), PS_PM_FLAGS), PM_FLAG_FOLLOW) << "the camera";
            ASSERT_EQ(read_int(sent.data(), PS_CLIENT_NUMBER), viewer);
            const State anna_before = game.snapshot(anna);
            join(how);
            EXPECT_FALSE(game.shows_camera(viewer));
            EXPECT_EQ(read_int(game.state(viewer), PS_PM_TYPE), PM_NORMAL);
            EXPECT_FALSE(blends(sent, game.snapshot(viewer)));
            EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
            EXPECT_EQ(game.snapshot(anna), anna_before) << "another player";
        }
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

// Clients take at most every frame, or skip frames when `snaps` is lower than the server's rate.
TEST_F(OpenArenaViewers, NoChangeOfViewIsBlendedWhenAClientSkipsFrames) {
    const auto view = [&] {
        if (game.shows_camera(viewer)) return std::string("camera");
        const State state = game.snapshot(viewer);
        if (read_int(state.data(), PS_PM_TYPE) == PM_NORMAL && read_int(state.data(), PS_PM_FLAGS) == 0)
            return std::string("player");
        return std::to_string(read_int(state.data(), PS_PM_FLAGS));
    };
    for (const int every : {1, 2}) {
        for (int phase = 0; phase < every; ++phase) {
            State received = game.snapshot(viewer);
            std::string received_view = view();
            for (int i = 0; i < 400; ++i) {
                if (i % 20 == 3) game.join_team(viewer, team_free);
                if (i % 20 == 7 + i / 20 % 3) game.join_team(viewer, team_spectator);
                if (i % 20 == 15 && i % 3 == 0) game.client_command(viewer, {"director", "off"});
                if (i % 20 == 17) game.client_command(viewer, {"director", "auto"});
                if (i % 40 > 30 && i % 40 < 37)
                    game.run_frame();
                else
                    watch(anna, 1);
                if (i % every != phase) continue;
                const State state = game.snapshot(viewer);
                EXPECT_FALSE(view() != received_view && blends(received, state))
                    << received_view << " to " << view() << ", frame " << i << ", every " << every;
                received = state;
                received_view = view();
            }
        }
    }
}

TEST_F(OpenArenaViewers, ACameraOfTheFutureDoesNotKeepOutTheNextOnes) {
    watch(anna, 1, 3);
    game.set_camera(viewer, anna, 1, x += 5);
    game.report.cameras[viewer].level_time += 1'000'000;
    game.run_frame();
    watch(anna, 1, 10);
    EXPECT_TRUE(game.shows_camera(viewer));
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

TEST_F(OpenArenaViewers, AnIntermissionIsACutAndEndsTheCamera) {
    for (std::uint32_t segment = 1; segment < 3; ++segment) {
        watch(anna, 1, 3);
        watch(anna, segment, 1);
        const State sent = game.snapshot(viewer);
        ASSERT_TRUE(game.shows_camera(viewer));
        game.begin_intermission();
        watch(anna, segment);
        EXPECT_EQ(read_int(game.state(viewer), PS_PM_TYPE), PM_INTERMISSION);
        EXPECT_FALSE(blends(sent, game.snapshot(viewer)));
        EXPECT_EQ(game.snapshot(viewer), game.own(viewer));
        game.restart(true);
        watch(anna, 1, 3);
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

TEST_F(OpenArenaViewers, DeathAndRespawnOfTheTargetCutWhereTheDirectorCuts) {
    watch(anna, 1, 3);
    int bit = game.teleport_bit(viewer);
    game.kill(anna);
    watch(anna, 1, 3);
    EXPECT_EQ(game.teleport_bit(viewer), bit);
    EXPECT_EQ(vector(PS_VIEW_ANGLES)[0], 0) << "does not look down after the body's eye";
    game.respawn(anna);
    watch(anna, 1);
    EXPECT_EQ(game.teleport_bit(viewer), bit) << "until the director's camera jumps";
    watch(anna, 2);
    EXPECT_NE(game.teleport_bit(viewer), bit);
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

// Whatever happens in whatever order: players are not touched, the game sees its own states, and exactly the
// jumps between views are declared.
TEST(OpenArenaViewersProperty, AnyEvents) {
    rc::check([] {
        FakeServer game;
        game.connect_bot(anna, "Anna");
        game.connect_bot(bob, "Bob");
        game.connect_spectator(viewer, "Eve");
        game.run_frame();
        std::uint32_t segment = 1, shown_segment = 0;
        float x = 0;
        for (const int event : *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 40))) {
            const bool was_camera = game.shows_camera(viewer);
            const State before = game.snapshot(viewer);
            const auto bots = std::pair(game.snapshot(anna), game.snapshot(bob));
            switch (event) {
                case 0:
                    game.client_command(viewer, {"director", "off"});
                    break;
                case 1:
                    game.client_command(viewer, {"director", "auto"});
                    break;
                case 2:
                case 3:
                    game.follow(viewer, event - 2);
                    break;
                case 4:
                    game.call([&] { game.stop_following(viewer); });
                    break;
                case 5:
                    game.options.spectate ^= 1;
                    break;
                default:
                    break;
            }
            if (event > 5 && event < 12) ++segment;
            if (event > 8) game.set_camera(viewer, event % 2, segment, x += 3);
            game.run_frame(event % 3 == 0 ? 16 : 50);
            RC_ASSERT(bots == std::pair(game.snapshot(anna), game.snapshot(bob)));
            game.call([&] { RC_ASSERT(game.snapshot(viewer) == game.own(viewer)); });
            const bool camera = game.shows_camera(viewer);
            const std::uint32_t new_segment = game.report.cameras[viewer].segment;
            const int number = read_int(game.state(viewer), PS_CLIENT_NUMBER);
            const bool jump = camera ? !was_camera || new_segment != shown_segment : was_camera;
            const bool toggled =
                game.teleport_bit(viewer) != (read_int(before.data(), PS_EFLAGS) & EFLAG_TELEPORT);
            if (camera || number == read_int(before.data(), PS_CLIENT_NUMBER)) {
                if (camera || jump) RC_ASSERT(toggled == jump);
            }
            if (camera) shown_segment = new_segment;
        }
    });
}

}  // namespace
}  // namespace camdir::openarena
