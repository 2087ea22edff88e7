// A real game client on a display of its own.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "support/child_process.hpp"
#include "support/game/console_process.hpp"
#include "support/game/record_log.hpp"
#include "support/game/records.h"
#include "support/temporary_folder.hpp"

namespace camdir::test {

// Xvfb, which draws into memory.
class VirtualDisplay {
  public:
    VirtualDisplay(int width, int height);

    [[nodiscard]] std::string name() const { return name_; }  // of $DISPLAY

  private:
    ChildProcess process_;
    std::string name_;
};

struct GameClientOptions {
    std::string name = "watcher";
    int snaps = 20;
    int width = 640, height = 360;
    bool marker = true;  // with the files of support/game/marker_model.hpp
};

// The field of view that the client draws with: 90 degrees across, as its default.
class GameClient {
  public:
    // Joins a server on this machine as spectator.
    GameClient(int server_port, const GameClientOptions& options);
    // Plays a recording in steps of 50 ms, a picture each, and ends.
    GameClient(const std::filesystem::path& recording, const GameClientOptions& options);

    [[nodiscard]] ConsoleProcess& console() { return *console_; }
    // Every picture that it has drawn of a map.
    [[nodiscard]] const std::vector<drawn_record>& drawn() { return drawn_.read(); }
    // Waits for this many more pictures; false after a generous timeout or when the client ends.
    [[nodiscard]] bool draws(std::size_t more);
    // The file into which its console command `record NAME` records.
    [[nodiscard]] std::filesystem::path recording(const std::string& name) const;

  private:
    explicit GameClient(const GameClientOptions& options);
    void start(const std::vector<std::string>& commands);

    TemporaryFolder home_;
    VirtualDisplay display_;
    RecordLog<drawn_record> drawn_;
    std::unique_ptr<ConsoleProcess> console_;
};

}  // namespace camdir::test
