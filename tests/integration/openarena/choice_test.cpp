// A spectator's own choices.
#include <gmock/gmock.h>

#include "live_match.hpp"

namespace camdir::test {
namespace {

using testing::HasSubstr;
using testing::Not;

class OptOut : public LiveMatch {};

TEST_F(OptOut, TheSpectatorTurnsTheCameraOffAndOnByCommandAndChat) {
    ASSERT_NO_FATAL_FAILURE(join());
    client_->console().enter("cmd director off");
    ASSERT_TRUE(has_own_view()) << logs();
    ASSERT_TRUE(client_->draws(20)) << logs();
    ASSERT_FALSE(is_overlaid(*server_->newest(), slot_));
    client_->console().enter("cmd director auto");
    ASSERT_TRUE(has_camera()) << logs();

    client_->console().enter("cmd say \"!director off\"");
    ASSERT_TRUE(has_own_view()) << logs();
    client_->console().enter("cmd say \"!director auto\"");
    ASSERT_TRUE(has_camera()) << logs();
    EXPECT_THAT(server_->console().output(), Not(HasSubstr("!director"))) << "the chat shows the command";

    server_->console().enter("director off " + std::to_string(slot_));
    ASSERT_TRUE(has_own_view()) << logs();
    server_->console().enter("director auto " + std::to_string(slot_));
    ASSERT_TRUE(has_camera()) << logs();
    expect_players_untouched();
}

TEST_F(OptOut, WhoEntersTheGameHasTheirOwnView) {
    ASSERT_NO_FATAL_FAILURE(join());
    client_->console().enter("cmd team free");
    ASSERT_TRUE(server_->reaches([&](const witness_record& frame) { return frame.players[slot_].team == 0; }))
        << logs();
    ASSERT_TRUE(client_->draws(20)) << logs();
    expect_players_untouched();
    // The game refuses another change within 5 s.
    const int entered = server_->newest()->level_time;
    ASSERT_TRUE(server_->reaches([&](const witness_record& frame) {
        return frame.level_time > entered + 6000;
    })) << logs();
    client_->console().enter("cmd team spectator");
    ASSERT_TRUE(has_camera()) << logs();
    expect_players_untouched();
}

}  // namespace
}  // namespace camdir::test
