#include "poses.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "engine.h"

namespace camdir::openarena {
namespace {

class OpenArenaPose : public testing::Test {
  protected:
    OpenArenaPose() {
        entry.in_use = 1;
        write_int(state.data(), PS_PERSISTANT + 4 * PERSISTANT_SPAWN_COUNT, 1);
        write_int(state.data(), PS_STATS, 70);
        write_int(state.data(), PS_VIEW_HEIGHT, 26);
        write_int(state.data(), PS_WEAPON, 5);
        const float origin[3] = {1.0F, 2.0F, 3.0F}, velocity[3] = {4.0F, 5.0F, 6.0F};
        write_vector(state.data(), PS_ORIGIN, origin);
        write_vector(state.data(), PS_VELOCITY, velocity);
    }

    player_pose pose() { return pose_of(state.data(), &entry, true); }

    std::vector<std::uint8_t> state = std::vector<std::uint8_t>(player_state_size);
    match_player entry{};
};

TEST_F(OpenArenaPose, ReadsAPlayer) {
    const player_pose read = pose();
    EXPECT_TRUE(read.in_game && read.bot && read.alive);
    EXPECT_FALSE(read.spectator);
    EXPECT_EQ(read.health, 70);
    EXPECT_EQ(read.weapon, 5);
    float eye[3];
    pose_eye(eye, &read);
    EXPECT_EQ(eye[0], 1.0F);
    EXPECT_EQ(eye[2], 29.0F);
    EXPECT_EQ(read.velocity[1], 5.0F);
}

TEST_F(OpenArenaPose, ASlotWithoutNameOrSpawnIsNotInTheGame) {
    entry.in_use = 0;
    EXPECT_FALSE(pose().in_game);
    entry.in_use = 1;
    write_int(state.data(), PS_PERSISTANT + 4 * PERSISTANT_SPAWN_COUNT, 0);
    EXPECT_FALSE(pose().in_game);
}

TEST_F(OpenArenaPose, TheDeadAreNotAlive) {
    write_int(state.data(), PS_PM_TYPE, PM_DEAD);
    EXPECT_FALSE(pose().alive);
    EXPECT_FALSE(pose().spectator);
}

// A follower's state is a copy of the followed player's: only the roster and the flag tell.
TEST_F(OpenArenaPose, SpectatorsFollowersAndTheIntermissionHaveNoBody) {
    entry.team = team_spectator;
    EXPECT_TRUE(pose().spectator);
    entry.team = team_red;
    EXPECT_FALSE(pose().spectator);
    write_int(state.data(), PS_PM_FLAGS, PM_FLAG_FOLLOW);
    EXPECT_TRUE(pose().spectator);
    write_int(state.data(), PS_PM_FLAGS, 0);
    for (const int type : {PM_SPECTATOR, PM_INTERMISSION}) {
        write_int(state.data(), PS_PM_TYPE, type);
        EXPECT_TRUE(pose().spectator);
        EXPECT_FALSE(pose().alive);
    }
}

TEST_F(OpenArenaPose, NumbersThatAreNotFiniteTakeThePlayerOut) {
    for (const float bad :
         {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        const float vector[3] = {0.0F, bad, 0.0F};
        write_vector(state.data(), PS_VIEW_ANGLES, vector);
        EXPECT_FALSE(pose().in_game);
    }
}

TEST_F(OpenArenaPose, JumpsAtRespawnTeleportAndJoining) {
    const player_pose before = pose();
    EXPECT_FALSE(pose_jumped(&before, &before));
    write_int(state.data(), PS_EFLAGS, EFLAG_TELEPORT);
    player_pose now = pose();
    EXPECT_TRUE(pose_jumped(&before, &now));
    const player_pose absent{};
    EXPECT_TRUE(pose_jumped(&absent, &before));
    now = before;
    now.spectator = 1;
    EXPECT_TRUE(pose_jumped(&now, &before));
}

}  // namespace
}  // namespace camdir::openarena
