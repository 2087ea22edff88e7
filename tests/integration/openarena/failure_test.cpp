// What a spectator sees when directors fail.
#include <gmock/gmock.h>

#include "live_match.hpp"

namespace camdir::test {
namespace {

class Failure : public LiveMatch {};

TEST_F(Failure, TheGamesOwnChaseViewReplacesADirectorThatIsKilledAndTheCameraComesBack) {
    ASSERT_NO_FATAL_FAILURE(join());
    const int slot = spectator().slot();
    ASSERT_TRUE(spectator().follows(2)) << logs();
    for (int round = 0; round < 2; ++round) {
        director_->kill();
        ASSERT_TRUE(spectator().has_own_view()) << logs();
        // The game's own follow of the same player.
        ASSERT_TRUE(server_->reaches([&](const witness_record& frame) {
            const witness_player& player = frame.players[slot];
            return (player.pm_flags & 4096) != 0 && player.client_num == 2;
        })) << logs();
        ASSERT_TRUE(spectator().client().draws(20)) << logs();
        ASSERT_FALSE(is_overlaid(*server_->newest(), slot));
        director_->start();
        ASSERT_TRUE(spectator().has_camera()) << logs();
        ASSERT_TRUE(spectator().client().draws(20)) << logs();
    }
    // Both changes are cuts for the client.
    const CommandedPath path(server_->witnessed(), slot);
    const auto& snapshots = path.snapshots();
    int changes = 0;
    for (std::size_t i = 1; i < snapshots.size(); ++i) {
        if (is_overlaid(snapshots[i - 1].frame, slot) == is_overlaid(snapshots[i].frame, slot)) continue;
        EXPECT_TRUE(snapshots[i].cut) << (is_overlaid(snapshots[i].frame, slot) ? "to" : "from")
                                      << " the camera at " << snapshots[i].frame.level_time << " ms";
        ++changes;
    }
    EXPECT_GE(changes, 5);
    expect_players_untouched();
}

TEST_F(Failure, AServerWithoutADirectorPlaysOn) {
    director_->kill();
    const int time = server_->newest()->level_time;
    ASSERT_TRUE(
        server_->reaches([&](const witness_record& frame) { return frame.level_time > time + 2000; }));
    EXPECT_THAT(status(), testing::HasSubstr("directors"));
    expect_players_untouched();
}

}  // namespace
}  // namespace camdir::test
