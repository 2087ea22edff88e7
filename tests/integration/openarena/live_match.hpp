// For the tests of the game module: a director, a game server with bots and the module, and spectators.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "support/game/camera_tape.hpp"
#include "support/game/director.hpp"
#include "support/game/game_server.hpp"
#include "support/game/spectator.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {

class LiveMatch : public testing::Test {
  protected:
    // On the first map; the director has all of them.
    explicit LiveMatch(std::vector<std::string> maps = {"oa_dm1"});

    // Skips without the packages.
    void SetUp() override;

    // Adds a client that spectates; waits until it has drawn the director's camera.
    void join(const GameClientOptions& options = {});
    [[nodiscard]] Spectator& spectator(std::size_t number = 0) { return *spectators_.at(number); }

    [[nodiscard]] std::string status() { return server_->console().ask("director status"); }
    // Logs of everyone, for failures.
    [[nodiscard]] std::string logs();

    // The module changed no player's state in any frame, only spectators'.
    void expect_players_untouched();

    static constexpr int bots = 8;
    std::map<std::string, std::string> settings_;  // the server's cvars
    TestDomain domain_;
    std::optional<GameDirector> director_;
    std::optional<GameServer> server_;
    std::optional<CameraTape> tape_;

  private:
    std::vector<std::string> maps_;
    std::vector<std::unique_ptr<Spectator>> spectators_;
};

}  // namespace camdir::test
