// The Debian packages that a game on this machine needs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace camdir::test {

// The message of a test that is skipped for want of one of them; none when all are installed.
[[nodiscard]] inline std::optional<std::string> needs_game_package() {
    for (const auto& [file, package] :
         {std::pair{"/usr/games/openarena-server", "openarena-server"},
          std::pair{"/usr/games/openarena", "openarena"}, std::pair{"/usr/bin/Xvfb", "xvfb"},
          std::pair{"/usr/lib/x86_64-linux-gnu/dri/swrast_dri.so", "libgl1-mesa-dri"}}) {
        if (!std::filesystem::exists(file)) return std::string("needs the package ") + package;
    }
    return std::nullopt;
}

}  // namespace camdir::test
