#include "support/game/game_server.hpp"

#include <sys/socket.h>

#include <array>
#include <fstream>

#include "support/free_port.hpp"

namespace camdir::test {
namespace {

constexpr std::array bot_names = {"penguin", "sarge", "gargoyle", "sergei",
                                  "kyonshi", "tony",  "angelyss", "rai"};

std::string line_to_add(int bot) {
    return std::string("addbot ") + bot_names.at(static_cast<std::size_t>(bot)) + " " +
           std::to_string(2 + bot % 4);
}

void place_witness(const std::filesystem::path& file, const std::filesystem::path& next) {
    std::filesystem::copy_file(CAMDIR_TEST_WITNESS, file);
    std::ofstream(file.string() + ".next") << next.string() << "\n";
}

}  // namespace

std::filesystem::path director_module() {
    return CAMDIR_TEST_MODULE;
}

std::filesystem::path plain_module() {
    return "/usr/lib/openarena-server/baseoa/qagamex86_64.so";
}

GameServer::GameServer(const GameServerOptions& options)
    : port_(free_port(SOCK_DGRAM)),
      outer_(home_ / "baseoa/qagamex86_64.so.log"),
      inner_(home_ / "inner.so.log") {
    std::filesystem::create_directories(home_ / "baseoa");
    place_witness(home_ / "baseoa/qagamex86_64.so", options.module);
    std::ofstream config(home_ / "baseoa/test.cfg");
    for (const char* line :
         {"sv_pure 0", "sv_maxclients 16", "bot_enable 1", "bot_nochat 1", "bot_minplayers 0", "g_gametype 0",
          "fraglimit 0", "timelimit 0", "g_doWarmup 0", "g_inactivity 0", "g_log \"\"", "sv_floodProtect 0",
          "sv_maxRate 0", "sv_lanForceRate 1"}) {
        config << "set " << line << "\n";
    }
    if (options.witness_inside) {
        place_witness(home_ / "inner.so", plain_module());
        config << "set director_game " << (home_ / "inner.so").string() << "\n";
    }
    for (const auto& [name, value] : options.settings)
        config << "set " << name << " \"" << value << "\"\n";
    config << "map " << options.map << "\n";
    for (int bot = 0; bot < options.bots; ++bot)
        config << line_to_add(bot) << "\n";
    config.close();
    std::vector<std::string> command = {"/usr/games/openarena-server"};
    const auto set = [&](const std::string& name, const std::string& value) {
        command.insert(command.end(), {"+set", name, value});
    };
    set("fs_homepath", home_.path().string());
    set("dedicated", "1");
    set("net_enabled", "1");  // IPv4 only
    set("net_ip", "127.0.0.1");
    set("net_port", std::to_string(port_));
    for (int master = 1; master <= 5; ++master)
        set("sv_master" + std::to_string(master), "");
    set("vm_game", "0");
    set("ttycon", "0");
    set("com_hunkMegs", "256");
    set("sv_fps", std::to_string(options.rate));
    command.insert(command.end(), {"+exec", "test.cfg"});
    console_ = std::make_unique<ConsoleProcess>(command);
}

std::optional<witness_record> GameServer::newest() {
    const auto& records = witnessed();
    if (records.empty() || records.back().kind != witness_ran_frame) return std::nullopt;
    return records.back();
}

void GameServer::add_bots(int count) {
    for (int bot = 0; bot < count; ++bot)
        console_->enter(line_to_add(bot));
}

bool GameServer::ready(int bots) {
    return reaches([&](const witness_record& frame) {
        int playing = 0;
        for (const witness_player& player : frame.players)
            playing += player.bot && player.in_game;
        return playing == bots;
    });
}

}  // namespace camdir::test
