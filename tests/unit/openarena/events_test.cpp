#include "events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "engine.h"
#include "roster.h"

namespace camdir::openarena {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// "kind actor>subject value detail", with - for no slot.
std::string text(const game_event& event) {
    const auto slot = [](std::uint8_t number) { return number == no_slot ? "-" : std::to_string(number); };
    return std::to_string(event.kind) + " " + slot(event.actor) + ">" + slot(event.subject) + " " +
           std::to_string(static_cast<int>(event.value)) + " " + event.detail;
}

vitals healthy() {
    vitals found{};
    found.present = found.alive = 1;
    found.health = 100;
    found.spawn_count = 1;
    return found;
}

std::vector<std::string> between(const vitals& before, const vitals& now) {
    game_event events[max_events];
    const std::uint32_t count = append_player_events(events, 0, 3, &before, &now);
    std::vector<std::string> texts;
    for (std::uint32_t i = 0; i < count; ++i) {
        texts.push_back(text(events[i]));
    }
    return texts;
}

TEST(OpenArenaPlayerEvents, NothingHappensBetweenEqualFrames) {
    EXPECT_THAT(between(healthy(), healthy()), IsEmpty());
    EXPECT_THAT(between(vitals{}, healthy()), IsEmpty());
    EXPECT_THAT(between(healthy(), vitals{}), IsEmpty());
}

TEST(OpenArenaPlayerEvents, DamageNamesTheAttacker) {
    vitals now = healthy();
    now.damage_event = 1;
    now.damage = 40;
    now.attacker = 5;
    EXPECT_THAT(between(healthy(), now), ElementsAre("5 5>3 40 "));
    now.attacker = ENTITY_NUMBER_WORLD;
    EXPECT_THAT(between(healthy(), now), ElementsAre("5 ->3 40 "));
    EXPECT_THAT(between(now, now), IsEmpty()) << "the damage of a frame before";
    now.alive = 0;
    EXPECT_THAT(between(healthy(), now), IsEmpty()) << "the kill says it";
}

TEST(OpenArenaPlayerEvents, PowerUpsAndFlags) {
    vitals now = healthy();
    now.power_ups[1] = 31'000;
    EXPECT_THAT(between(healthy(), now), ElementsAre("7 3>- 0 item_quad"));
    vitals longer = now;
    longer.power_ups[1] = 50'000;
    EXPECT_THAT(between(now, longer), ElementsAre("7 3>- 0 item_quad"));
    EXPECT_THAT(between(now, healthy()), IsEmpty());
    vitals carrier = healthy();
    carrier.power_ups[8] = 1;
    EXPECT_THAT(between(healthy(), carrier), ElementsAre("2 3>- 2 team_CTF_blueflag"));
    vitals scorer = healthy();
    scorer.captures = 1;
    EXPECT_THAT(between(carrier, scorer), ElementsAre("3 3>- 0 team_CTF_blueflag"));
}

TEST(OpenArenaPlayerEvents, HealthAndArmourOfWeight) {
    vitals now = healthy();
    now.health = 200;
    EXPECT_THAT(between(healthy(), now), ElementsAre("7 3>- 100 item_health_mega"));
    vitals hurt = healthy();
    hurt.health = 20;
    EXPECT_THAT(between(hurt, healthy()), IsEmpty()) << "large health gives 50 at most";
    now = healthy();
    now.armor = 50;
    EXPECT_THAT(between(healthy(), now), ElementsAre("7 3>- 50 item_armor_combat"));
    now.armor = 100;
    EXPECT_THAT(between(healthy(), now), ElementsAre("7 3>- 100 item_armor_body"));
    now.armor = 5;
    EXPECT_THAT(between(healthy(), now), IsEmpty());
}

TEST(OpenArenaPlayerEvents, ARespawnIsNoItem) {
    vitals dead = healthy(), now = healthy();
    dead.alive = 0;
    dead.health = -40;
    now.health = 125;
    now.armor = 100;
    now.spawn_count = 2;
    EXPECT_THAT(between(dead, now), IsEmpty());
}

TEST(OpenArenaPlayerEvents, Awards) {
    vitals now = healthy();
    now.awards[1] = 1;
    EXPECT_THAT(between(healthy(), now), ElementsAre("6 3>- 0 excellent"));
}

TEST(OpenArenaPlayerEvents, NeverMoreThanFit) {
    vitals now = healthy();
    for (std::int32_t& award : now.awards) {
        award = 1;
    }
    game_event events[max_events];
    const vitals before = healthy();
    EXPECT_EQ(append_player_events(events, max_events - 2, 3, &before, &now), max_events);
}

TEST(OpenArenaMeans, AreTheGamesNames) {
    EXPECT_STREQ(means_name(3), "MOD_MACHINEGUN");
    EXPECT_STREQ(means_name(7), "MOD_ROCKET_SPLASH");
    EXPECT_STREQ(means_name(20), "MOD_SUICIDE");
    EXPECT_STREQ(means_name(28), "MOD_GRAPPLE");
    for (const int unknown : {-1, 0, 29, 1 << 30}) {
        EXPECT_STREQ(means_name(unknown), "MOD_UNKNOWN");
    }
    for (int means = 0; means < 40; ++means) {
        EXPECT_LE(std::strlen(means_name(means)), 31U);
    }
}

// With a game's arrays in memory, but no engine.
class OpenArenaEvents : public testing::Test {
  protected:
    OpenArenaEvents() {
        const std::intptr_t arguments[engine_call_arguments] = {
            reinterpret_cast<std::intptr_t>(entities.data()), entity_count, entity_size,
            reinterpret_cast<std::intptr_t>(clients.data()), player_state_size};
        engine_locate(arguments);
        roster_reset();
        events_reset(game_of_players);
    }
    ~OpenArenaEvents() override { engine_forget_game_data(); }

    std::uint8_t* entity(int number) { return entities.data() + number * entity_size; }
    std::uint8_t* client(int slot) { return clients.data() + slot * player_state_size; }

    void enter(int slot, std::uint8_t team = team_free) {
        frame.players[slot].in_game = frame.players[slot].alive = 1;
        frame.players[slot].team = team;
        write_int(client(slot), PS_PERSISTANT + 4 * PERSISTANT_SPAWN_COUNT,
                  read_element(client(slot), PS_PERSISTANT, PERSISTANT_SPAWN_COUNT) + 1);
    }
    void show_obituary(int number, int victim, int killer, int means) {
        write_int(entity(number), ENTITY_TYPE, ENTITY_TYPE_OBITUARY);
        write_int(entity(number), ENTITY_OTHER, victim);
        write_int(entity(number), ENTITY_OTHER2, killer);
        write_int(entity(number), ENTITY_EVENT_PARAMETER, means);
    }
    std::vector<std::string> sample() {
        frame.event_count = 0;
        events_sample(&frame);
        std::vector<std::string> texts;
        for (std::uint32_t i = 0; i < frame.event_count; ++i) {
            texts.push_back(text(frame.events[i]));
        }
        return texts;
    }

    static constexpr int entity_count = 100, entity_size = 600;
    std::vector<std::uint8_t> entities = std::vector<std::uint8_t>(entity_count * entity_size);
    std::vector<std::uint8_t> clients = std::vector<std::uint8_t>(std::size_t{max_slots} * player_state_size);
    server_frame frame{};
};

TEST_F(OpenArenaEvents, AnObituaryIsOneKill) {
    show_obituary(70, 2, 1, 6);
    EXPECT_THAT(sample(), ElementsAre("1 1>2 1 MOD_ROCKET"));
    EXPECT_THAT(sample(), IsEmpty());
    write_int(entity(70), ENTITY_TYPE, 0);
    EXPECT_THAT(sample(), IsEmpty());
    show_obituary(70, 2, 1, 6);
    EXPECT_THAT(sample(), ElementsAre("1 1>2 1 MOD_ROCKET"));
    show_obituary(70, 2, ENTITY_NUMBER_WORLD, 19);
    EXPECT_THAT(sample(), ElementsAre("1 ->2 0 MOD_FALLING"));
}

TEST_F(OpenArenaEvents, KillingOneselfOrOnesOwnSideCosts) {
    show_obituary(70, 2, 2, 7);
    EXPECT_THAT(sample(), ElementsAre("1 2>2 -1 MOD_ROCKET_SPLASH"));
    events_reset(game_of_teams);
    frame.players[1].team = frame.players[2].team = team_red;
    show_obituary(70, 2, 1, 6);
    EXPECT_THAT(sample(), ElementsAre("1 1>2 -1 MOD_ROCKET"));
}

TEST_F(OpenArenaEvents, ARoundLastsFromWarmUpToIntermission) {
    events_take_configstring(CONFIGSTRING_WARMUP, "-1");
    enter(0);
    EXPECT_THAT(sample(), IsEmpty());
    events_take_configstring(CONFIGSTRING_WARMUP, "");
    enter(1);
    EXPECT_THAT(sample(), ElementsAre("8 ->- 1 begin"));
    events_take_configstring(CONFIGSTRING_RED_SCORE, "3");
    EXPECT_THAT(sample(), IsEmpty());
    events_take_configstring(CONFIGSTRING_INTERMISSION, "1");
    EXPECT_THAT(sample(), ElementsAre("8 ->- 1 end"));
    EXPECT_THAT(sample(), IsEmpty());
}

TEST_F(OpenArenaEvents, EliminationHasARoundForEachPoint) {
    EXPECT_EQ(events_game_kind(8), game_with_rounds);
    EXPECT_EQ(events_game_kind(4), game_of_teams);
    EXPECT_EQ(events_game_kind(0), game_of_players);
    EXPECT_EQ(events_game_kind(10), game_of_players);  // scores rise within its rounds
    events_reset(game_with_rounds);
    enter(0);
    EXPECT_THAT(sample(), ElementsAre("8 ->- 1 begin"));
    events_take_configstring(CONFIGSTRING_RED_SCORE, "1");
    EXPECT_THAT(sample(), ElementsAre("8 ->- 1 end"));
    EXPECT_THAT(sample(), IsEmpty());
    enter(0);
    EXPECT_THAT(sample(), ElementsAre("8 ->- 2 begin"));
}

TEST_F(OpenArenaEvents, SpectatorsHaveNone) {
    enter(4);
    (void)sample();
    frame.players[4].spectator = 1;  // and follows someone who is hit
    write_int(client(4), PS_DAMAGE_EVENT, 9);
    write_int(client(4), PS_DAMAGE_COUNT, 30);
    EXPECT_THAT(sample(), IsEmpty());
}

TEST_F(OpenArenaEvents, GameDataThatDoesNotFitIsRefused) {
    const std::intptr_t base = reinterpret_cast<std::intptr_t>(entities.data());
    const std::intptr_t bad[][engine_call_arguments] = {
        {0, 100, 600, base, 500},     {base, 100, 600, 0, 500},    {base, 63, 600, base, 500},
        {base, 1025, 600, base, 500}, {base, 100, 531, base, 500}, {base, 100, 600, base, 467},
        {base, -1, -1, base, -1},
    };
    for (const auto& arguments : bad) {
        engine_locate(arguments);
        EXPECT_EQ(engine_player_state(0), nullptr);
        EXPECT_EQ(engine_entity_count(), 0);
    }
}

}  // namespace
}  // namespace camdir::openarena
