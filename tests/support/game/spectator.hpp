// A client that spectates a server with the game module.
#pragma once

#include <optional>
#include <vector>

#include "support/game/camera_tape.hpp"
#include "support/game/commanded_path.hpp"
#include "support/game/game_client.hpp"
#include "support/game/game_server.hpp"

namespace camdir::test {

[[nodiscard]] bool is_human_spectator(const witness_player& player);
// The engine sends this slot a view of its own that follows nobody: the director's camera.
[[nodiscard]] bool is_overlaid(const witness_record& frame, int slot);

// How far, in map units, what a slot is sent lies outside the free space of each of the director's cameras of
// the last 250 ms, of one player when one is named: the least of that. Infinite without such a camera.
[[nodiscard]] double distance_to_cameras(const witness_record& frame, int slot,
                                         const std::vector<CameraTape::Entry>& tape,
                                         std::optional<int> player = std::nullopt);

// All functions that return bool wait for it, and return false after a generous time.
class Spectator {
  public:
    // Starts the client. The server's other clients have been connected already.
    Spectator(GameServer& server, const CameraTape& tape, const GameClientOptions& options = {});

    [[nodiscard]] GameClient& client() { return client_; }
    [[nodiscard]] int slot() const { return slot_; }  // -1 until it has joined

    // It spectates, and has drawn the director's camera.
    [[nodiscard]] bool joins();
    // It is sent the director's camera of the player, after asking for it.
    [[nodiscard]] bool follows(int player);
    // It is sent the director's camera, or the game's own view.
    [[nodiscard]] bool has_camera();
    [[nodiscard]] bool has_own_view();
    // It draws the director's camera in the map's present life.
    [[nodiscard]] bool draws_camera();

  private:
    GameServer& server_;
    const CameraTape& tape_;
    std::vector<bool> earlier_;  // slots of other clients
    GameClient client_;
    int slot_ = -1;
};

}  // namespace camdir::test
