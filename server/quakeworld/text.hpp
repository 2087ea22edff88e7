// Texts of the game.
#pragma once

#include <string>
#include <string_view>

namespace camdir::quakeworld {

// The game's character set as ASCII: letters of another colour lose it, signs become '[', ']', '.' or '?',
// and so do line feeds.
[[nodiscard]] std::string plain(std::string_view text);
// Likewise, with its line feeds.
[[nodiscard]] std::string plain_lines(std::string_view text);

// The value of a key in \key\value\key\value, as it is written; empty where there is none.
[[nodiscard]] std::string_view value_of(std::string_view info, std::string_view key);

}  // namespace camdir::quakeworld
