// The spectators' own choices, on a server that lets in only clients with the game's own files.
#include <gmock/gmock.h>

#include <algorithm>

#include "live_match.hpp"

namespace camdir::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Choice : public LiveMatch {
  protected:
    Choice() { settings_["sv_pure"] = "1"; }

    void join_unmodified(const std::string& name) {
        GameClientOptions options;
        options.name = name;
        options.width = 320;
        options.height = 180;
        options.marker = false;
        join(options);
    }

    [[nodiscard]] int now() { return server_->newest()->level_time; }

    // The director's cameras that a spectator was sent in a time were of this player.
    void expect_cameras_of(int player, Spectator& spectator, int begin, int end) {
        const auto tape = tape_->entries();
        int cameras = 0;
        for (const witness_record& frame : server_->witnessed()) {
            if (frame.level_time < begin || frame.level_time > end || !is_overlaid(frame, spectator.slot()))
                continue;
            ++cameras;
            if (tape_->gaps() > 0) continue;
            EXPECT_LE(distance_to_cameras(frame, spectator.slot(), tape, player), 0.01)
                << frame.level_time << " ms";
        }
        EXPECT_GE(cameras, 10);
    }
};

TEST_F(Choice, TheCameraIsTurnedOffAndOnByCommandAndChat) {
    ASSERT_NO_FATAL_FAILURE(join_unmodified("watcher"));
    ConsoleProcess& client = spectator().client().console();
    EXPECT_THAT(client.ask("sv_pure"), HasSubstr("is:\"1"));
    client.enter("cmd director off");
    ASSERT_TRUE(spectator().has_own_view()) << logs();
    ASSERT_TRUE(spectator().client().draws(20)) << logs();
    ASSERT_FALSE(is_overlaid(*server_->newest(), spectator().slot()));
    client.enter("cmd director auto");
    ASSERT_TRUE(spectator().has_camera()) << logs();

    client.enter("cmd say \"!director off\"");
    ASSERT_TRUE(spectator().has_own_view()) << logs();
    client.enter("cmd say \"!director auto\"");
    ASSERT_TRUE(spectator().has_camera()) << logs();
    EXPECT_THAT(server_->console().output(), Not(HasSubstr("!director"))) << "the chat shows the command";

    const std::string slot = std::to_string(spectator().slot());
    server_->console().enter("director off " + slot);
    ASSERT_TRUE(spectator().has_own_view()) << logs();
    server_->console().enter("director auto " + slot);
    ASSERT_TRUE(spectator().has_camera()) << logs();
    expect_players_untouched();
}

TEST_F(Choice, WhoEntersTheGameHasTheirOwnView) {
    ASSERT_NO_FATAL_FAILURE(join_unmodified("watcher"));
    ConsoleProcess& client = spectator().client().console();
    client.enter("cmd team free");
    ASSERT_TRUE(server_->reaches([&](const witness_record& frame) {
        return frame.players[spectator().slot()].team == 0;
    })) << logs();
    ASSERT_TRUE(spectator().client().draws(20)) << logs();
    expect_players_untouched();
    // The game refuses another change within 5 s.
    const int entered = now();
    ASSERT_TRUE(server_->reaches([&](const witness_record& frame) {
        return frame.level_time > entered + 6000;
    })) << logs();
    client.enter("cmd team spectator");
    ASSERT_TRUE(spectator().has_camera()) << logs();
    expect_players_untouched();
}

TEST_F(Choice, EachOfTwoSpectatorsHasTheirOwnShot) {
    ASSERT_NO_FATAL_FAILURE(join_unmodified("first"));
    ASSERT_NO_FATAL_FAILURE(join_unmodified("second"));
    Spectator &first = spectator(0), &second = spectator(1);
    ASSERT_NE(first.slot(), second.slot());
    ASSERT_TRUE(first.follows(1)) << logs();
    ASSERT_TRUE(second.follows(2)) << logs();
    const int both = now();
    ASSERT_TRUE(first.client().draws(40)) << logs();
    ASSERT_TRUE(second.client().draws(40)) << logs();
    EXPECT_TRUE(first.draws_camera()) << logs();
    EXPECT_TRUE(second.draws_camera()) << logs();
    const int end = now();

    first.client().console().enter("cmd director off");
    ASSERT_TRUE(first.has_own_view()) << logs();
    const int alone = now();
    ASSERT_TRUE(second.client().draws(40)) << logs();
    EXPECT_TRUE(second.draws_camera()) << logs();
    EXPECT_FALSE(is_overlaid(*server_->newest(), first.slot()));
    const int last = now();

    // The observer of the director's cameras has received those of the last frame.
    ASSERT_TRUE(eventually([&] {
        const auto tape = tape_->entries();
        return !tape.empty() && tape.back().level_time >= last;
    })) << logs();
    expect_cameras_of(1, first, both, end);
    expect_cameras_of(2, second, both, end);
    expect_cameras_of(2, second, alone, last);
    expect_players_untouched();
}

}  // namespace
}  // namespace camdir::test
