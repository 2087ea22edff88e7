// A player model for clients of tests: a ball in a colour that no map has, drawn without lighting.
#pragma once

#include <filesystem>

namespace camdir::test {

// Around the player's origin, map units. It lies in the player's box (30 x 30 x 56, 24 of them below the
// origin).
inline constexpr double marker_radius = 12.0;

// Writes the model of the first bot and its magenta shader below a client's baseoa folder.
void write_marker_model(const std::filesystem::path& folder);

}  // namespace camdir::test
