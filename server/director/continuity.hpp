// Respawns and teleports whose own frames never came.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "director/messages.hpp"

namespace camdir::director {

// Remembers how many discontinuities each player of an epoch had at the player's last pose. One thread at a
// time. Allocates only for new players.
class Continuity {
  public:
    static constexpr std::size_t max_known = 2 * max_players;

    void clear() { counts_.clear(); }

    // Whether the player has respawned or teleported since the pose given before: the pose says so itself,
    // or has another count. To be called for the poses in the order of their frames, whichever are missing.
    // More than max_known different players make it forget all counts.
    [[nodiscard]] bool broken(const PlayerPose& pose);

  private:
    std::unordered_map<std::uint32_t, std::uint32_t> counts_;  // by player
};

// For a frame that is left out: a later one of the same epoch declares what it declares. Not every game
// server counts discontinuities.
void carry_discontinuities(const PoseFrame& from, PoseFrame& to);

}  // namespace camdir::director
