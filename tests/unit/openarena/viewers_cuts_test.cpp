// Where a client must not blend two snapshots.
#include "viewers.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "viewers_fixture.hpp"

namespace camdir::openarena {
namespace {

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
