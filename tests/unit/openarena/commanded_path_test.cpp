// What the pictures of a real client are judged by.
#include "support/game/commanded_path.hpp"

#include <gtest/gtest.h>

namespace camdir::test {
namespace {

constexpr int spectator = 0, player = 1;
constexpr int teleported = 4;  // entity flag, toggled

witness_record snapshot(int time, float x, int entity_flags) {
    witness_record record{};
    record.kind = witness_ran_frame;
    record.sent = 1;
    record.level_time = time;
    record.players[player].base[0] = x;
    record.players[player].velocity[0] = 300.0F;  // per second
    record.players[player].entity_flags = entity_flags;
    return record;
}

double x_at(int time, const std::vector<witness_record>& records, Motion motion = Motion::interpolated) {
    return CommandedPath(records, spectator).player(player, time, records.size() - 1, motion).x();
}

TEST(CommandedPath, PlayersMoveBetweenSnapshots) {
    EXPECT_EQ(x_at(425, {snapshot(400, 10.0F, 0), snapshot(450, 20.0F, 0)}), 15.0);
}

TEST(CommandedPath, PlayersGoOnUntilTheyAreShownElsewhere) {
    const std::vector<witness_record> records = {snapshot(400, 10.0F, 0), snapshot(450, 900.0F, teleported)};
    EXPECT_EQ(x_at(440, records), 22.0);
    EXPECT_EQ(x_at(450, records), 900.0);
}

TEST(CommandedPath, PlayersGoOnWhileTheNextSnapshotIsLate) {
    const std::vector<witness_record> records = {snapshot(400, 10.0F, 0), snapshot(450, 20.0F, 0)};
    EXPECT_EQ(x_at(460, records), 23.0);
    EXPECT_EQ(x_at(440, records, Motion::extrapolated), 22.0) << "as who is not in it";
}

}  // namespace
}  // namespace camdir::test
