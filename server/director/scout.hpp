// What the cameras that follow the players, and those that stand still, would show at one instant.
#pragma once

#include <span>
#include <vector>

#include "direction/footage.hpp"
#include "freespace/space.hpp"

namespace camdir::director {

// Of a match of more, whom a player sees, and whom their camera shows, is asked of so many nearest others.
inline constexpr std::size_t most_looked_at = 31;

// A beat in the making: places, views and teams of the players are given, what they and their cameras see is
// found out player by player. A camera stands behind its player's eye on the line of view, 120 units of
// 0.0254 m away or as far as is free, looks along it, and shows 90 degrees across in the format 16:9. It is
// no tracker's: one that looks ahead is not made before it is due.
struct Scout {
    // With the first so many of the map's fixed shots.
    explicit Scout(std::size_t fixed_shots = 0) : fixed(fixed_shots), takes(fixed_shots) {}

    std::size_t fixed;
    std::vector<direction::PlayerState> players;
    std::vector<direction::Take> takes;  // of the fixed cameras, then of the one that follows each player
    std::vector<direction::Index> present;
    std::size_t done = 0;  // of those present

    // One more, who is not present.
    void add_player();
    [[nodiscard]] bool finished() const { return done == present.size(); }
    // Of the next one: whom the player sees of those after (or, of many, of those nearest), what their camera
    // shows of the same, and which of the fixed cameras show them. `space`: at the time of the beat, the same
    // for all. `unit`: 0.0254 m in map units. Precondition: not finished.
    void look(const freespace::Space& space, float unit);

  private:
    std::vector<direction::PlayerSet> looked_at_;  // by player: whom of those nearest they have looked at

    [[nodiscard]] bool has_many() const { return present.size() > most_looked_at + 1; }
    [[nodiscard]] std::vector<direction::Index> nearest_to(direction::Index self) const;
    void look_from_behind(const freespace::Space& space, float unit, direction::Index self,
                          std::span<const direction::Index> others);
    void look_from_fixed(const freespace::Space& space, float unit, direction::Index self);
};

}  // namespace camdir::director
