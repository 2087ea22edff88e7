// What a server prints when a player dies.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace camdir::quakeworld {

struct Obituary {
    std::string_view cause;  // a weapon, "team", or of a death without a killer: self, fall, liquid, world
    std::optional<std::size_t> killer;  // index of the name
    std::optional<std::size_t> victim;  // nothing where the text names only a killer, of a team mate
};

// Of a line without its end. `names` are those of the players, which may hold anything; empty ones are
// nobody's. Text and names are plain().
[[nodiscard]] std::optional<Obituary> obituary_of(std::string_view line, std::span<const std::string> names);

}  // namespace camdir::quakeworld
