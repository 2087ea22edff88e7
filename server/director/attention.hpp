// Chooses the target of automatic shots by what happens to the players.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "config/config.hpp"
#include "director/messages.hpp"
#include "director/roster.hpp"

namespace camdir::director {

// An automatic shot's current choice. Times are the game's, ns.
struct AutomaticTarget {
    std::uint32_t player = no_player;
    std::int64_t chosen_at = 0;
    std::int64_t died_at = 0;  // valid while `dead`
    bool dead = false;
};

// Every player has a score: the worth of the player's recent events in kills, halved every
// matches.automatic_half_life_s. Damage counts by its hit points, of at most 100. One thread at a time.
class Attention {
  public:
    void clear() { scores_.clear(); }

    void record(const MatchEvent& event, double half_life_s);

    // Updates the target for the frame at game time `now`. Candidates are the players of `group` (ascending),
    // or all who play when it is empty; the best is alive, has the highest score, then the lowest id. A
    // living target is kept for automatic_hold_s and until another leads by automatic_lead; a dead one
    // for 1.5 s, so that the death is seen.
    void choose(AutomaticTarget& target, std::span<const std::uint32_t> group,
                std::span<const PlayerPose> poses, const Roster& roster, const config::Matches& rules,
                std::int64_t now) const;

  private:
    struct Score {
        std::uint32_t player;
        double value;
        std::int64_t at;
    };

    void add(std::uint32_t player, double value, std::int64_t at, double half_life_s);
    [[nodiscard]] double score(std::uint32_t player, std::int64_t now, double half_life_s) const;

    std::vector<Score> scores_;  // at most max_players
};

}  // namespace camdir::director
