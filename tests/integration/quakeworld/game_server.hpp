// A real QuakeWorld server with bots: mvdsv and KTX of Debian.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "spectator.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::test {

// The message of a test that is skipped for want of a package or of the map; none when all is there.
[[nodiscard]] std::optional<std::string> needs_for_quakeworld();

// A map that bots know, a file of Quake's format.
inline constexpr const char* bot_map = "dm4";
[[nodiscard]] std::filesystem::path bot_map_file();

// A game of everyone against everyone, without an end. Throws where the server does not start.
class QuakeWorldServer {
  public:
    explicit QuakeWorldServer(int bots);

    [[nodiscard]] int qtv_port() const { return qtv_port_; }
    // Waits until so many bots have entered the game.
    [[nodiscard]] bool ready() const;
    [[nodiscard]] std::string log() const { return process_->output() + process_->errors(); }
    // For servers that want one.
    static constexpr const char* password = "open sesame";

  private:
    void write_configuration() const;

    TemporaryFolder folder_;
    int bots_;
    int game_port_;
    int qtv_port_;
    std::unique_ptr<ChildProcess> process_;
    std::unique_ptr<QuakeWorldSpectator> host_;
};

}  // namespace camdir::test
