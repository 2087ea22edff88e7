#include "commands.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_server.hpp"

namespace camdir::openarena {
namespace {

using testing::HasSubstr;

constexpr int viewer = 4;

class OpenArenaCommands : public testing::Test {
  protected:
    OpenArenaCommands() {
        game.connect_bot(0, "Anna");
        game.connect_spectator(viewer, "Eve");
        for (int i = 0; i < 3; ++i)
            game.run_frame();
        game.forget_sent();
    }
    viewer_status status() {
        viewer_status result{};
        EXPECT_TRUE(viewers_status(viewer, &result));
        return result;
    }
    std::string answer() {
        const auto sent = game.sent_to(viewer);
        game.forget_sent();
        return sent.empty() ? "" : sent.back();
    }
    std::string console(std::vector<std::string> words) {
        game.printed.clear();
        EXPECT_TRUE(game.console_command(std::move(words)));
        return game.printed;
    }
    FakeServer game;
};

TEST_F(OpenArenaCommands, ClientsChooseByCommandAndChat) {
    EXPECT_TRUE(game.client_command(viewer, {"director", "off"}));
    EXPECT_EQ(status().choice, choice_off);
    EXPECT_TRUE(game.client_command(viewer, {"say", "!director auto"}));
    EXPECT_EQ(status().choice, choice_auto);
    EXPECT_TRUE(game.client_command(viewer, {"say_team", "!director", "profile", "wide-2"}));
    EXPECT_STREQ(status().profile, "wide-2");
    EXPECT_EQ(answer(), "print \"director: profile wide-2\n\"\n");
    EXPECT_TRUE(game.client_command(viewer, {"director", "profile"}));
    EXPECT_STREQ(status().profile, "");
}

TEST_F(OpenArenaCommands, TheGameHasAllOtherCommands) {
    EXPECT_FALSE(game.client_command(viewer, {"say", "the !director is nice"}));
    EXPECT_FALSE(game.client_command(viewer, {"say", ""}));
    EXPECT_FALSE(game.client_command(viewer, {"say"}));
    EXPECT_FALSE(game.client_command(viewer, {"directory"}));
    EXPECT_FALSE(game.client_command(viewer, {"score"}));
    EXPECT_FALSE(game.console_command({"status"}));
    EXPECT_EQ(answer(), "");
}

TEST_F(OpenArenaCommands, WhatIsWrongIsAnswered) {
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"director", "on"}, {"director", "off", "4"}, {"director", "auto", "x"}}) {
        EXPECT_TRUE(game.client_command(viewer, words));
        EXPECT_THAT(answer(), HasSubstr("usage: director auto | off | profile NAME | status"));
    }
    for (const std::string name :
         {"a\"b", "a;b", "a\\b", "\x80", "0123456789012345678901234567890123456789"}) {
        EXPECT_TRUE(game.client_command(viewer, {"director", "profile", name}));
        EXPECT_THAT(answer(), HasSubstr("at most 31 letters, digits and -_."));
        EXPECT_STREQ(status().profile, "");
    }
    game.options.spectate = 0;
    EXPECT_TRUE(game.client_command(viewer, {"director", "auto"}));
    EXPECT_THAT(answer(), HasSubstr("director_spectate 0"));
}

TEST_F(OpenArenaCommands, TheConsoleChoosesForASlot) {
    console({"director", "off", "4"});
    EXPECT_EQ(status().choice, choice_off);
    console({"director", "profile", "wide", "4"});
    EXPECT_STREQ(status().profile, "wide");
    EXPECT_THAT(console({"director", "off"}), HasSubstr("usage: "));
    EXPECT_THAT(console({"director", "off", "0"}), HasSubstr("slot 0 is no human spectator"));
    for (const char* slot : {"64", "-1", "x", "", "4x", "99999999999999999999"}) {
        EXPECT_THAT(console({"director", "off", slot}), HasSubstr("usage: "));
    }
    EXPECT_THAT(console({"director", "profile", "a", "b", "c", "d", "e", "f"}), HasSubstr("usage: "));
}

TEST_F(OpenArenaCommands, StatusSaysWhatEachViewerSees) {
    game.report.shots[viewer].state = CDIR_SHOT_WAITING_FOR_MAP;
    snprintf(game.report.shots[viewer].reason, sizeof game.report.shots[viewer].reason, "no \"x\"\nhere");
    game.client_command(viewer, {"director", "status"});
    EXPECT_EQ(answer(),
              "print \"viewer 4 Eve: auto, profile of the director, sees free flight of nobody, "
              "shot waiting for the map: no 'x' here\n\"\n");
    game.set_camera(viewer, 0, 1, 5);
    game.run_frame();
    EXPECT_THAT(console({"director"}), HasSubstr("sees the director's camera of Anna, 50 ms old"));
    game.has_report = false;
    EXPECT_THAT(console({"director", "status"}), HasSubstr("not connected yet"));
    game.join_team(viewer, team_free);
    game.run_frame();
    game.client_command(viewer, {"director"});
    EXPECT_THAT(answer(), HasSubstr("for spectators"));
}

}  // namespace
}  // namespace camdir::openarena
