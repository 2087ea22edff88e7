#include "refusal_notice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fake_server.hpp"

namespace camdir::openarena {
namespace {

using testing::HasSubstr;

constexpr int viewer = 4;

class OpenArenaRefusalNotice : public testing::Test {
  protected:
    OpenArenaRefusalNotice() {
        game.connect_bot(0, "Anna");
        connect();
    }
    void connect() {
        game.connect_spectator(viewer, "Eve");
        game.run_frame();
        game.forget_sent();
    }
    void answer(std::uint32_t state, const std::string& reason = "") {
        viewer_shot& shot = game.report.shots[viewer];
        shot.state = state;
        std::snprintf(shot.reason, sizeof shot.reason, "%s", reason.c_str());
    }
    void refuse(const std::string& reason) { answer(CDIR_SHOT_REFUSED, reason); }
    // The lines that the viewer gets in frames of 50 ms.
    std::vector<std::string> lines(int frames) {
        for (int i = 0; i < frames; ++i)
            game.run_frame();
        const auto sent = game.sent_to(viewer);
        game.forget_sent();
        return sent;
    }
    FakeServer game;
};

TEST_F(OpenArenaRefusalNotice, ARefusalIsPrintedOnceWithWhatToDo) {
    answer(CDIR_SHOT_UNANSWERED);
    EXPECT_EQ(lines(40).size(), 0U);
    refuse("there is no profile \"fast\"; known: wide");
    const auto printed = lines(1000);
    ASSERT_EQ(printed.size(), 1U);
    EXPECT_EQ(printed[0],
              "print \"director: no camera: there is no profile 'fast'; known: wide. 'director profile NAME' "
              "asks for another profile, 'director off' for none\n\"\n");
}

TEST_F(OpenArenaRefusalNotice, AMapThatIsNotServedIsTold) {
    answer(CDIR_SHOT_WAITING_FOR_MAP, "map 'oa_dm2' is not configured; known: oa_dm1");
    const auto printed = lines(1000);
    ASSERT_EQ(printed.size(), 1U);
    EXPECT_EQ(printed[0], "print \"director: no camera: map 'oa_dm2' is not configured; known: oa_dm1\n\"\n");
}

TEST_F(OpenArenaRefusalNotice, TheNextRefusalIsPrintedToo) {
    refuse("one");
    EXPECT_EQ(lines(200).size(), 1U);
    answer(CDIR_SHOT_ACCEPTED);
    EXPECT_EQ(lines(200).size(), 0U);
    refuse("one");
    EXPECT_EQ(lines(200).size(), 1U);
    refuse("two");
    const auto printed = lines(200);
    ASSERT_EQ(printed.size(), 1U);
    EXPECT_THAT(printed[0], HasSubstr("two"));
}

TEST_F(OpenArenaRefusalNotice, ReasonsThatChangeAllTheTimeArePrintedEveryFiveSeconds) {
    std::size_t count = 0;
    for (int i = 0; i < 60; ++i) {
        refuse(std::to_string(i));
        count += lines(20).size();
    }
    EXPECT_EQ(count, 12U) << "in 60 s";
    for (int i = 0; i < 400; ++i) {
        if (i % 3 == 0)
            refuse("again");
        else
            answer(CDIR_SHOT_ACCEPTED);
        count += lines(1).size();
    }
    EXPECT_EQ(count, 12U) << "no refusal lasts";
}

TEST_F(OpenArenaRefusalNotice, AnAnswerToAnEarlierRequestIsNotPrinted) {
    refuse("of the slot's previous client");
    EXPECT_EQ(lines(5).size(), 0U);
    game.disconnect(viewer);
    connect();
    EXPECT_EQ(lines(5).size(), 0U);
    answer(CDIR_SHOT_UNANSWERED);
    EXPECT_EQ(lines(20).size(), 0U);
}

TEST_F(OpenArenaRefusalNotice, WhoDoesNotAskForAShotIsToldNothing) {
    refuse("full");
    game.client_command(viewer, {"director", "off"});
    game.forget_sent();
    EXPECT_EQ(lines(100).size(), 0U);
    game.client_command(viewer, {"director", "auto"});
    game.join_team(viewer, team_free);
    game.forget_sent();
    EXPECT_EQ(lines(100).size(), 0U);
}

}  // namespace
}  // namespace camdir::openarena
