// A real game server with bots.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "support/eventually.hpp"
#include "support/game/console_process.hpp"
#include "support/game/record_log.hpp"
#include "support/game/records.h"
#include "support/temporary_folder.hpp"

namespace camdir::test {

// The module under test.
[[nodiscard]] std::filesystem::path director_module();
// The game's own.
[[nodiscard]] std::filesystem::path plain_module();

struct GameServerOptions {
    std::string map = "oa_dm1";
    int rate = 20;  // sv_fps
    int bots = 8;
    std::map<std::string, std::string> settings;  // cvars
    std::filesystem::path module = director_module();
    bool witness_inside = false;  // a second witness between the module and the game's own
};

class GameServer {
  public:
    // The bot whose model support/game/marker_model.hpp replaces; its slot is 0.
    static constexpr int marker_slot = 0;

    explicit GameServer(const GameServerOptions& options);

    [[nodiscard]] ConsoleProcess& console() { return *console_; }
    [[nodiscard]] int port() const { return port_; }

    // What the engine was about to send after each frame, since the start.
    [[nodiscard]] const std::vector<witness_record>& witnessed() { return outer_.read(); }
    // The same before the module under test changed it; needs witness_inside.
    [[nodiscard]] const std::vector<witness_record>& witnessed_inside() { return inner_.read(); }
    // The newest frame; none before the first one of a map.
    [[nodiscard]] std::optional<witness_record> newest();
    // Waits until condition(newest frame) holds; false after a generous timeout, or when the server ends.
    template <class Condition>
    [[nodiscard]] bool reaches(Condition condition) {
        bool reached = false;
        static_cast<void>(eventually([&] {
            const auto frame = newest();
            reached = frame && condition(*frame);
            return reached || !console_->runs();
        }));
        return reached;
    }
    // Adds the first bots of the list.
    void add_bots(int count);
    // Waits until so many bots play.
    [[nodiscard]] bool ready(int bots);

  private:
    TemporaryFolder home_;
    int port_;
    RecordLog<witness_record> outer_, inner_;
    std::unique_ptr<ConsoleProcess> console_;
};

}  // namespace camdir::test
