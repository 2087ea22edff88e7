#include "live_match.hpp"

#include <cstring>

#include "support/game/packages.hpp"
#include "support/openarena.hpp"

namespace camdir::test {
namespace {

// What the game decides about a player, and what others see of them.
bool same_state(const witness_player& a, const witness_player& b) {
    return a.pm_type == b.pm_type && a.pm_flags == b.pm_flags && a.view_flags == b.view_flags &&
           a.client_num == b.client_num && a.view_height == b.view_height && a.health == b.health &&
           std::memcmp(a.origin, b.origin, sizeof a.origin) == 0 &&
           std::memcmp(a.angles, b.angles, sizeof a.angles) == 0 &&
           std::memcmp(a.base, b.base, sizeof a.base) == 0 && a.entity_flags == b.entity_flags;
}

}  // namespace

LiveMatch::LiveMatch(std::vector<std::string> maps) : maps_(std::move(maps)) {}

void LiveMatch::SetUp() {
    if (const auto needs = needs_game_package()) GTEST_SKIP() << *needs;
    for (const std::string& map : maps_) {
        if (!openarena_map(map)) GTEST_SKIP() << needs_openarena_map(map);
    }
    director_.emplace(domain_.id(), maps_);
    GameServerOptions options;
    options.map = maps_.front();
    options.bots = bots;
    options.witness_inside = true;
    options.settings = settings_;
    options.settings["director_domain"] = std::to_string(domain_.id());
    server_.emplace(options);
    tape_.emplace(domain_.id(), "openarena-" + std::to_string(server_->port()));
    ASSERT_TRUE(director_->ready()) << director_->log();
    ASSERT_TRUE(server_->ready(bots)) << server_->console().output();
}

void LiveMatch::join(const GameClientOptions& options) {
    spectators_.push_back(std::make_unique<Spectator>(*server_, *tape_, options));
    ASSERT_TRUE(spectators_.back()->joins()) << logs();
}

std::string LiveMatch::logs() {
    const auto end_of = [](const std::string& text) {
        constexpr std::size_t enough = 2000;
        return text.size() > enough ? "..." + text.substr(text.size() - enough) : text;
    };
    std::string all = "status:\n" + status() + "director:\n" + end_of(director_->log()) + "server:\n" +
                      end_of(server_->console().output());
    for (const auto& spectator : spectators_)
        all += "client:\n" + end_of(spectator->client().console().output());
    return all;
}

void LiveMatch::expect_players_untouched() {
    const auto& outer = server_->witnessed();
    const auto& inner = server_->witnessed_inside();
    std::size_t next = 0;
    int compared = 0;
    for (const witness_record& sent : outer) {
        if (sent.kind != witness_ran_frame) continue;
        while (next < inner.size() && inner[next].kind != witness_ran_frame)
            ++next;
        if (next == inner.size()) break;
        const witness_record& own = inner[next++];
        ASSERT_EQ(own.level_time, sent.level_time);
        for (int slot = 0; slot < witness_slots; ++slot) {
            if (!sent.players[slot].connected || is_human_spectator(sent.players[slot])) continue;
            ASSERT_TRUE(same_state(own.players[slot], sent.players[slot]))
                << "slot " << slot << " at " << sent.level_time << " ms";
            ++compared;
        }
    }
    EXPECT_GT(compared, 0);
}

}  // namespace camdir::test
