// What a viewer chose last, in every order of commands, buttons, frames and the module's own orders.
#include "choice.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "fake_server.hpp"

namespace camdir::openarena {
namespace {

constexpr int viewer = 4, anna = 0, bob = 1, cora = 2;

// Whom a viewer watches: as they said last.
struct Expected {
    enum { director, player, nobody } what = director;
    int slot = -1;
};

class Game {
  public:
    Game() {
        server.connect_bot(anna, "Anna");
        server.connect_bot(bob, "Bob");
        server.connect_bot(cora, "Cora");
        server.connect_spectator(viewer, "Eve");
        frames(5, anna);
    }
    // The director's choice is `target`.
    void frames(int count, int target) {
        for (int i = 0; i < count; ++i) {
            server.set_camera(viewer, target, segment, 0);
            server.run_frame();
        }
    }
    void say(std::vector<std::string> words) { server.client_command(viewer, std::move(words)); }
    void attack() {
        server.call([&] { server.execute(viewer, {"follownext"}); });
    }
    void use() {
        server.call([&] { server.execute(viewer, {"follow"}); });
    }
    int game_follows() {
        const State own = server.own(viewer);
        const bool follows = (read_int(own.data(), PS_PM_FLAGS) & PM_FLAG_FOLLOW) != 0;
        return follows ? read_int(own.data(), PS_CLIENT_NUMBER) : -1;
    }
    // After everything has settled, with the director on `target`.
    void expect(const Expected& expected, int target, const std::string& when) {
        ++segment;
        frames(50, target);
        const viewer_request request = server.request(viewer);
        switch (expected.what) {
            case Expected::director:
                EXPECT_TRUE(request.active == 1 && request.mode == viewer_auto) << when;
                EXPECT_EQ(game_follows(), target) << when;
                break;
            case Expected::player:
                EXPECT_TRUE(request.active == 1 && request.mode == viewer_follow) << when;
                EXPECT_EQ(request.target, expected.slot) << when;
                EXPECT_EQ(game_follows(), expected.slot) << when;
                break;
            case Expected::nobody:
                EXPECT_EQ(request.active, 0) << when;
                EXPECT_EQ(game_follows(), -1) << when;
                break;
        }
    }

    FakeServer server;
    std::uint32_t segment = 1;
};

struct Action {
    std::vector<std::string> words;
    Expected result;
};

const std::vector<Action> actions = {
    {{"director", "auto"}, {Expected::director}},
    {{"follow", "1"}, {Expected::player, bob}},
    {{"follow", "2"}, {Expected::player, cora}},
    {{"follow", "Bob"}, {Expected::player, bob}},
    {{"follow", "bOb"}, {Expected::player, bob}},
    {{"Follow", "0"}, {Expected::player, anna}},
    {{"follow"}, {Expected::nobody}},
};

TEST(OpenArenaChoice, TheLastOfSeveralCommandsInOneMomentHolds) {
    for (const Action& first : actions) {
        for (const Action& second : actions) {
            for (const Action& third : actions) {
                Game game;
                for (const Action* action : {&first, &second, &third})
                    game.say(action->words);
                const std::string when =
                    first.words.back() + ", " + second.words.back() + ", " + third.words.back();
                game.expect(third.result, anna, when);
                game.expect(third.result, cora, when + ", and the director changes its mind");
            }
        }
    }
}

TEST(OpenArenaChoice, TheLastOfTwoCommandsSomeFramesApartHolds) {
    for (const int frames : {1, 2, 30}) {
        for (const int target : {int{anna}, int{bob}}) {
            for (const Action& first : actions) {
                for (const Action& second : actions) {
                    Game game;
                    for (const Action* action : {&first, &second}) {
                        game.say(action->words);
                        ++game.segment;
                        game.frames(frames, target);
                    }
                    game.expect(second.result, cora, first.words.back() + ", " + second.words.back());
                }
            }
        }
    }
}

TEST(OpenArenaChoice, FollowTogetherWithSpectating) {
    using Words = std::vector<std::vector<std::string>>;
    const std::vector<std::pair<Words, Expected>> orders = {
        {{{"team", "s"}, {"follow", "1"}}, {Expected::player, bob}},
        {{{"follow", "1"}}, {Expected::player, bob}},  // the game makes a player a spectator
        {{{"follownext"}}, {Expected::player, bob}},
        {{{"follow", "1"}, {"team", "s"}}, {Expected::director}},
        {{{"follow"}, {"team", "s"}}, {Expected::director}},
        {{{"team", "s"}, {"follow"}}, {Expected::nobody}},
        {{{"team", "s"}, {"follow", "1"}, {"director", "auto"}}, {Expected::director}},
        {{{"team", "s"}, {"director", "auto"}, {"follow", "1"}}, {Expected::player, bob}},
        {{{"director", "auto"}, {"team", "s"}, {"follow", "1"}}, {Expected::player, bob}},
        {{{"director", "off"}, {"director", "auto"}, {"follow", "1"}}, {Expected::player, bob}},
        {{{"team", "s"}, {"follow", "4"}}, {Expected::director}},  // oneself
        {{{"team", "s"}, {"follow", "9"}}, {Expected::director}},
        {{{"team", "s"}, {"follow", "nobody"}}, {Expected::director}},
    };
    for (const auto& [commands, expected] : orders) {
        Game game;
        std::string when;
        game.server.join_team(viewer, team_free);
        game.frames(5, anna);
        for (const auto& words : commands) {
            game.say(words);
            when += words[0] + " ";
        }
        game.expect(expected, anna, when);
        game.expect(expected, cora, when);
    }
}

TEST(OpenArenaChoice, ButtonsBeforeTheFirstFrame) {
    Game game;
    game.server.join_team(viewer, team_free);
    game.frames(5, anna);
    game.say({"team", "s"});
    game.attack();
    game.expect({Expected::player, bob}, anna, "attack");
}

TEST(OpenArenaChoice, ButtonsWhileACameraIsShown) {
    Game game;
    game.attack();
    game.expect({Expected::player, bob}, anna, "attack, from Anna");
    game.attack();
    game.expect({Expected::player, cora}, anna, "attack again");
    game.use();
    game.expect({Expected::nobody}, anna, "use");
    game.say({"director", "auto"});
    game.expect({Expected::director}, bob, "auto");
    game.use();
    game.expect({Expected::nobody}, bob, "use");
    game.attack();
    game.expect({Expected::player, bob}, cora, "attack in free flight");
}

TEST(OpenArenaChoice, RefusedCommandsChangeNothing) {
    for (const std::string target : {"4", "9", "nobody", "-1", "99999999999"}) {
        Game game;
        game.say({"follow", target});
        game.expect({Expected::director}, bob, target);
        game.say({"follow", "2"});
        game.say({"follow", target});
        game.expect({Expected::player, cora}, anna, target);
    }
}

TEST(OpenArenaChoice, WhenTheServerSwitchesTheCameraOffTheChosenPlayerIsFollowedOn) {
    Game game;
    game.say({"follow", "1"});
    game.frames(5, anna);
    game.server.options.spectate = 0;
    game.frames(5, anna);
    EXPECT_EQ(game.server.request(viewer).active, 0);
    EXPECT_EQ(game.game_follows(), bob);
    game.say({"follow", "2"});
    game.frames(5, anna);
    EXPECT_EQ(game.game_follows(), cora);
    game.server.options.spectate = 1;
    game.expect({Expected::player, cora}, anna, "chosen while it was off");
    game.say({"director", "auto"});
    game.frames(5, anna);
    game.server.options.spectate = 0;
    game.frames(5, anna);
    EXPECT_EQ(game.game_follows(), -1) << "the director's choice";
    game.server.options.spectate = 1;
    game.expect({Expected::director}, bob, "on again");
}

TEST(OpenArenaChoice, OffIsLeftAloneWhateverTheGameFollows) {
    Game game;
    game.say({"director", "off"});
    game.say({"follow", "1"});
    game.frames(50, anna);
    EXPECT_EQ(game.game_follows(), bob) << "chosen after it";
    EXPECT_EQ(game.server.request(viewer).active, 0);
    game.say({"director", "auto"});
    game.frames(50, anna);
    game.say({"follow", "1"});
    game.say({"director", "off"});
    game.frames(50, anna);
    EXPECT_EQ(game.game_follows(), -1) << "free flight";
    game.say({"director", "auto"});
    game.expect({Expected::director}, cora, "auto");
}

TEST(OpenArenaChoice, APlayerWhoLeaves) {
    for (const std::string how : {"gone", "replaced", "spectates"}) {
        for (const bool chosen : {false, true}) {
            Game game;
            if (chosen) game.say({"follow", "1"});
            game.frames(5, bob);
            if (how == "spectates") {
                game.server.join_team(bob, team_spectator);
            } else {
                game.server.disconnect(bob);
            }
            if (how == "replaced") game.server.connect_bot(bob, "Dora");
            game.expect(
                {chosen ? (how == "replaced" ? Expected::player : Expected::nobody) : Expected::director,
                 bob},
                anna, how + (chosen ? ", chosen" : ", the director's"));
        }
    }
}

// The module asked the game to follow Bob, who leaves before it does.
TEST(OpenArenaChoice, APlayerWhoLeavesBeforeTheGameFollowsThem) {
    Game game;
    ++game.segment;
    game.frames(1, bob);
    game.server.disconnect(bob);
    game.expect({Expected::director}, cora, "left");
}

TEST(OpenArenaChoice, AnEliminatedPlayerWhoWatchesAnotherIsStillTheOneFollowed) {
    for (const bool chosen : {false, true}) {
        Game game;
        if (chosen) game.say({"follow", "1"});
        game.frames(5, bob);
        for (const int watched : {int{anna}, int{cora}, int{anna}}) {
            game.server.follow(bob, watched);  // and stays in the team
            for (int i = 0; i < 5; ++i) {
                game.frames(1, bob);
                EXPECT_EQ(game.server.request(viewer).mode, chosen ? viewer_follow : viewer_auto);
                EXPECT_EQ(game.server.request(viewer).target, chosen ? bob : no_slot);
            }
        }
        game.say({"director", "auto"});
        game.expect({Expected::director}, anna, "auto");
    }
}

TEST(OpenArenaChoice, OutlivesAMapAndAnIntermission) {
    for (const bool same_map : {true, false}) {
        for (const bool intermission : {true, false}) {
            Game game;
            game.say({"follow", "1"});
            game.frames(5, anna);
            if (intermission) game.server.begin_intermission();
            game.frames(5, anna);
            game.server.restart(same_map);
            game.expect({Expected::player, bob}, cora, "chosen");
            game.say({"director", "auto"});
            game.frames(5, anna);
            if (intermission) game.server.begin_intermission();
            game.frames(5, anna);
            game.server.restart(same_map);
            game.expect({Expected::director}, cora, "the director's");
        }
    }
}

}  // namespace
}  // namespace camdir::openarena
