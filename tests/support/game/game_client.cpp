#include "support/game/game_client.hpp"

#include <fstream>
#include <stdexcept>

#include "support/eventually.hpp"
#include "support/game/marker_model.hpp"

namespace camdir::test {

namespace {

void write_settings(const std::filesystem::path& file, const GameClientOptions& options) {
    std::ofstream config(file);
    const auto set = [&](const std::string& name, const auto& value) {
        config << "set " << name << " \"" << value << "\"\n";
    };
    set("r_mode", -1);
    set("r_customwidth", options.width);
    set("r_customheight", options.height);
    set("r_fullscreen", 0);
    set("r_ignorehwgamma", 1);
    set("cl_renderer", "opengl1");
    for (const char* cheap : {"r_vertexLight", "r_fastsky"})
        set(cheap, 1);
    set("r_picmip", 4);
    set("s_initsound", 0);
    set("in_mouse", 0);
    set("ttycon", 0);
    set("com_introplayed", 1);
    set("com_maxfps", 40);
    for (const char* unlimited : {"com_maxfpsUnfocused", "com_maxfpsMinimized"})
        set(unlimited, 0);
    set("cl_allowDownload", 0);
    set("net_enabled", 1);  // IPv4 only
    set("rate", 90000);
    set("snaps", options.snaps);
    config << "seta name \"" << options.name << "\"\nsetu team s\n";
    // Only the map and its models, all of them loaded at once and free of effects on one another.
    for (const char* off : {"cg_draw2D", "cg_drawGun", "cg_shadows", "cg_gibs", "cg_marks", "cg_brassTime",
                            "cg_deferPlayers", "cg_drawCrosshair", "cg_smoothClients", "cg_autoswitch"}) {
        set(off, 0);
    }
    set("con_notifytime", 0);
    set("cg_fov", 90);
}

}  // namespace

VirtualDisplay::VirtualDisplay(int width, int height)
    : process_({"/usr/bin/Xvfb", "-displayfd", "1", "-nolisten", "tcp", "-screen", "0",
                std::to_string(width) + "x" + std::to_string(height) + "x24"}) {
    if (!eventually([&] { return process_.output().ends_with("\n"); }))
        throw std::runtime_error("Xvfb does not start: " + process_.errors());
    name_ = ":" + process_.output();
    name_.pop_back();
}

GameClient::GameClient(const GameClientOptions& options)
    : display_(options.width, options.height), drawn_(home_ / "drawn.log") {
    std::filesystem::create_directories(home_ / "baseoa/demos");
    if (options.marker) write_marker_model(home_ / "baseoa");
    write_settings(home_ / "baseoa/autoexec.cfg", options);
}

GameClient::GameClient(int server_port, const GameClientOptions& options) : GameClient(options) {
    start({"+connect", "127.0.0.1:" + std::to_string(server_port)});
}

GameClient::GameClient(const std::filesystem::path& recording, const GameClientOptions& options)
    : GameClient(options) {
    std::filesystem::copy_file(recording, home_ / "baseoa/demos" / recording.filename());
    start({"+set", "timedemo", "1", "+set", "nextdemo", "quit", "+demo", recording.stem().string()});
}

void GameClient::start(const std::vector<std::string>& commands) {
    std::vector<std::string> command = {"/usr/bin/env",
                                        "DISPLAY=" + display_.name(),
                                        "LIBGL_ALWAYS_SOFTWARE=1",
                                        "LP_NUM_THREADS=1",
                                        "SDL_AUDIODRIVER=dummy",
                                        std::string("LD_PRELOAD=") + CAMDIR_TEST_DRAWN_VIEWS,
                                        "CAMDIR_DRAWN_VIEWS=" + (home_ / "drawn.log").string(),
                                        "/usr/games/openarena",
                                        "+set",
                                        "fs_homepath",
                                        home_.path().string()};
    command.insert(command.end(), commands.begin(), commands.end());
    console_ = std::make_unique<ConsoleProcess>(command);
}

std::filesystem::path GameClient::recording(const std::string& name) const {
    return home_ / "baseoa/demos" / (name + ".dm_71");
}

bool GameClient::draws(std::size_t more) {
    const std::size_t goal = drawn().size() + more;
    return eventually([&] { return drawn().size() >= goal || !console_->runs(); }) && drawn().size() >= goal;
}

}  // namespace camdir::test
