// What a player carries, as the server's stats say.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "quakeworld/messages.hpp"

namespace camdir::quakeworld {

struct Inventory {
    std::int32_t health = 0;
    std::int32_t armour = 0;
    std::uint32_t items = 0;  // bits

    void apply(const Stat& stat);
};

// The items that a player took between two frames: weapons, armours, mega-health and powers that they did not
// have, or that made them stronger. None in the frame of a respawn, which hands out items.
[[nodiscard]] std::vector<std::string_view> taken_items(const Inventory& before, const Inventory& after);

}  // namespace camdir::quakeworld
