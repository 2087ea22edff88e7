extern "C" {
#include "players.h"
}

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace camdir::halflife {
namespace {

std::array<entity, 64> entities;
const char* const names[] = {"", "anna", "bart", "carl"};

const char* text_of(int string) {
    return names[string];
}

entity* entity_of(int index) {
    return &entities.at(static_cast<std::size_t>(index));
}

std::vector<game_event> events;

// A map with the players 1 to 3, seen once.
class HalfLifePlayers : public testing::Test {
  protected:
    HalfLifePlayers() {
        std::array<engine_function, engine_call_count> table{};
        table[call_text_of] = reinterpret_cast<engine_function>(text_of);
        table[call_entity_of] = reinterpret_cast<engine_function>(entity_of);
        static const engine_globals globals{};
        engine_connect(table.data(), &globals);
        entities = {};
        events.clear();
        for (int id = 1; id <= 3; ++id) {
            entities.at(static_cast<std::size_t>(id)).game_data = this;
            player(id).player_name = id;
            player(id).flags = entity_client;
            player(id).health = 100.0F;
        }
        players_reset();
        sample();
        damage();
    }

    static entity_variables& player(int id) { return entities.at(static_cast<std::size_t>(id)).variables; }

    // The frame 50 ms after the previous one.
    const server_frame& sample() {
        time_ += 0.05;
        players_sample(&list_, time_, &frame_);
        return frame_;
    }
    bool discontinuous(std::uint32_t id) {
        sample();
        return (frame_.players[id - 1].flags & CDIR_POSE_DISCONTINUITY) != 0;
    }
    std::vector<game_event> damage() const {
        events.clear();
        players_damage(&list_, [](const game_event* event) { events.push_back(*event); });
        return events;
    }

    entity_list list_{entities.data(), 64, 8};
    double time_ = 1.0;
    server_frame frame_{};
};

TEST_F(HalfLifePlayers, AreThoseWhomTheGameHasPutIn) {
    EXPECT_EQ(sample().player_count, 3U);
    entities[1].game_data = nullptr;
    EXPECT_EQ(sample().player_count, 2U);
    player(2).flags = 0;
    EXPECT_EQ(sample().player_count, 1U);
    EXPECT_EQ(frame_.players[0].id, 3U);
    player(3).player_name = 0;
    EXPECT_EQ(sample().player_count, 0U);
    std::array<match_player, match_max_players> players{};
    players_identify(&list_, players.data());
    for (const match_player& player : players)
        EXPECT_EQ(player.in_use, 0);
}

TEST_F(HalfLifePlayers, WithoutAFinitePoseAreLeftOut) {
    for (float* number : {&player(2).origin[1], &player(2).velocity[0], &player(2).view_angles[2],
                          &player(2).view_offset[2]}) {
        *number = std::numeric_limits<float>::quiet_NaN();
        EXPECT_EQ(sample().player_count, 2U);
        *number = 0.0F;
        EXPECT_EQ(sample().player_count, 3U);
    }
}

TEST_F(HalfLifePlayers, DeadAreNotAliveAndObserversSpectate) {
    player(1).dead = 1;
    player(2).health = 0.0F;
    player(3).observer_mode = 4;
    sample();
    EXPECT_EQ(frame_.players[0].flags, 0U);
    EXPECT_EQ(frame_.players[1].flags, 0U);
    EXPECT_EQ(frame_.players[2].flags, static_cast<std::uint32_t>(CDIR_POSE_SPECTATOR));
}

TEST_F(HalfLifePlayers, WalkingFallingAndLiftsAreContinuous) {
    player(1).velocity[0] = 2000.0F;
    for (int i = 0; i < 10; ++i) {
        player(1).origin[0] += 100.0F;
        EXPECT_FALSE(discontinuous(1));
    }
    player(1).velocity[0] = 0.0F;
    player(1).origin[0] += 100.0F;
    EXPECT_FALSE(discontinuous(1)) << "stopped within the frame";
    player(2).origin[2] += 50.0F;
    EXPECT_FALSE(discontinuous(2)) << "a lift";
}

TEST_F(HalfLifePlayers, TeleportsSpawnsSetViewsAndArrivalsAreDiscontinuous) {
    player(1).origin[1] = 500.0F;
    EXPECT_TRUE(discontinuous(1));
    EXPECT_FALSE(discontinuous(1));
    player(1).fix_angles = 1;
    EXPECT_TRUE(discontinuous(1));
    EXPECT_FALSE(discontinuous(1)) << "bots keep the mark";
    player(1).dead = 2;
    EXPECT_FALSE(discontinuous(1));
    player(1).dead = 0;
    EXPECT_TRUE(discontinuous(1));
    entities[3].game_data = nullptr;
    sample();
    entities[3].game_data = this;
    EXPECT_TRUE(discontinuous(3));
    players_forget_poses();
    EXPECT_TRUE(discontinuous(2)) << "after a lost frame";
}

TEST_F(HalfLifePlayers, DamageIsLostHealthByWhoCausedIt) {
    player(1).health = 70.5F;
    player(1).damage_inflictor = &entities[2];
    player(2).health = -30.0F;
    player(2).damage_inflictor = &entities[40];  // a projectile
    entities[40].variables.owner = &entities[3];
    player(3).health = 150.0F;
    const auto received = damage();
    ASSERT_EQ(received.size(), 2U);
    EXPECT_EQ(received[0].kind, static_cast<std::uint32_t>(CDIR_EVENT_DAMAGE));
    EXPECT_EQ(received[0].actor, 2U);
    EXPECT_EQ(received[0].subject, 1U);
    EXPECT_EQ(received[0].value, 29.5F);
    EXPECT_EQ(received[1].actor, 3U);
    EXPECT_EQ(received[1].subject, 2U);
    EXPECT_EQ(received[1].value, 100.0F) << "health beyond death does not count";
    EXPECT_TRUE(damage().empty());
}

TEST_F(HalfLifePlayers, PointersOutsideTheListAreNobody) {
    entity elsewhere{};
    elsewhere.variables.owner = &entities[2];
    auto* inside = reinterpret_cast<entity*>(reinterpret_cast<char*>(&entities[2]) + 4);
    auto* beyond = reinterpret_cast<entity*>(reinterpret_cast<char*>(entities.data()) + sizeof entities);
    for (entity* inflictor : {&elsewhere, inside, beyond, entities.data(), static_cast<entity*>(nullptr)}) {
        player(1).health -= 1.0F;
        player(1).damage_inflictor = inflictor;
        const auto received = damage();
        ASSERT_EQ(received.size(), 1U);
        EXPECT_EQ(received[0].actor, CDIR_NO_PLAYER);
    }
    EXPECT_EQ(players_id(&list_, &entities[8]), 8U);
    EXPECT_EQ(players_id(&list_, &entities[9]), CDIR_NO_PLAYER);
    const entity_list no_map{nullptr, 0, 0};
    EXPECT_EQ(players_id(&no_map, &entities[1]), CDIR_NO_PLAYER);
}

}  // namespace
}  // namespace camdir::halflife
