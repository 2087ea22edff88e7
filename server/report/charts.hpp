// Each player's series over time.
#pragma once

#include <cstddef>
#include <string>

#include "report/subject.hpp"

namespace camdir::report {

// At most this many players have charts: those with the most frames that are not good.
inline constexpr std::size_t max_charted_players = 16;

// A foldable block for each player, with the player's faults over time as its title, and their legend.
[[nodiscard]] std::string charts(const Subject& subject);

}  // namespace camdir::report
