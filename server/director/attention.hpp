// Where something happens: the choice of an automatic target.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "config/config.hpp"
#include "director/messages.hpp"
#include "director/roster.hpp"

namespace camdir::director {

// What an automatic shot remembers of its choice. Times are the game's.
struct AutomaticTarget {
    std::uint32_t player = no_player;
    std::int64_t chosen_at = 0;
    std::int64_t died_at = 0;  // valid while dead
    bool dead = false;
};

// Every player has a score: what happened to him lately, in kills, halved every
// matches.automatic_half_life_s.
class Attention {
  public:
    void clear() { scores_.clear(); }

    void take_in(const MatchEvent& event, double half_life_s);

    // The target for the frame at `now`, out of `group` or, when it is empty, out of all who play: the
    // candidate with the highest score, living before dead, then the lowest id. A living target is kept for
    // automatic_hold_s and until another leads by automatic_lead; a dead one for a moment, so that his death
    // is seen.
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
