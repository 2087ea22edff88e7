// For the tests of the game module: a director, a game server with bots and the module, and a spectator's
// client.
#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "support/game/camera_tape.hpp"
#include "support/game/commanded_path.hpp"
#include "support/game/director.hpp"
#include "support/game/game_client.hpp"
#include "support/game/game_server.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {

constexpr int bots = 8;

// The engine sends this slot a view of its own that follows nobody: the director's camera.
[[nodiscard]] bool is_overlaid(const witness_record& frame, int slot);

class LiveMatch : public testing::Test {
  protected:
    explicit LiveMatch(std::vector<std::string> maps = {"oa_dm1"});

    // Skips without the packages.
    void SetUp() override;

    // A client joins as spectator; waits until it has drawn the director's camera, of the given player when
    // one is named.
    void join();
    void follow(int player);

    [[nodiscard]] std::string status() { return server_->console().ask("director status"); }
    // Waits until the spectator sees the director's camera, or the game's own view.
    [[nodiscard]] bool has_camera();
    [[nodiscard]] bool has_own_view();
    // Logs of everyone, for failures.
    [[nodiscard]] std::string logs();

    // The module changed no player's state in any frame, only spectators'.
    void expect_players_untouched();

    TestDomain domain_;
    std::optional<GameDirector> director_;
    std::optional<GameServer> server_;
    std::optional<CameraTape> tape_;
    std::optional<GameClient> client_;
    int slot_ = -1;  // the spectator's

  private:
    std::vector<std::string> maps_;
};

}  // namespace camdir::test
