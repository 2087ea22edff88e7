#include "game_server.hpp"

#include <sys/socket.h>

#include <fstream>

#include "support/eventually.hpp"
#include "support/free_port.hpp"
#include "support/shared_files.hpp"

namespace camdir::test {
namespace {

const std::filesystem::path server_program = "/usr/games/mvdsv";
const std::filesystem::path mod_folder = "/usr/share/games/quake/ktx";

std::string map_name() {
    return std::string("maps/") + bot_map + ".bsp";
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

}  // namespace

std::optional<std::string> needs_for_quakeworld() {
    if (!std::filesystem::exists(server_program)) return "needs the package mvdsv";
    if (!std::filesystem::exists(mod_folder)) return "needs the package ktx";
    if (!shared_file(map_name())) return needs_shared_file(map_name());
    return std::nullopt;
}

std::filesystem::path bot_map_file() {
    return shared_file(map_name()).value();
}

QuakeWorldServer::QuakeWorldServer(int bots)
    : bots_(bots), game_port_(free_port(SOCK_DGRAM)), qtv_port_(free_port(SOCK_STREAM)) {
    std::filesystem::create_directories(folder_ / "id1/maps");
    std::filesystem::create_directories(folder_ / "qw");
    std::filesystem::copy_file(bot_map_file(), folder_ / "id1" / map_name());
    std::filesystem::copy(mod_folder, folder_ / "ktx", std::filesystem::copy_options::recursive);
    write_configuration();
    process_ = std::make_unique<ChildProcess>(std::vector<std::string>{
        server_program.string(), "-basedir", folder_.path().string(), "-game", "ktx", "-ip", "127.0.0.1",
        "-port", std::to_string(game_port_), "-progtype", "1", "+exec", "server.cfg"});
    host_ = std::make_unique<QuakeWorldSpectator>(game_port_, bots);
}

// Neither a match that has to be begun nor a check of a client's files; nothing is looked up in the network.
void QuakeWorldServer::write_configuration() const {
    std::ofstream config(folder_ / "ktx/server.cfg");
    config << "exec mvdsv.cfg\nexec ktx.cfg\n"
           << "sv_getrealip 0\nsv_mapcheck 0\nmaxclients 16\ndeathmatch 3\ntimelimit 0\nfraglimit 0\n"
           << "set k_matchless 1\nset k_use_matchless_dir 0\nset k_maxclients 16\nset k_fb_enabled 1\n"
           << "set k_fb_skill 20\nset k_defmap " << bot_map << "\n"
           << "sv_demofps 30\nqtv_maxstreams 4\nqtv_password \"" << password << "\"\n"
           << "qtv_streamport " << qtv_port_ << "\nmap " << bot_map << "\n";
}

bool QuakeWorldServer::ready() const {
    return eventually([&] { return count(log(), "entered the game") >= static_cast<std::size_t>(bots_); });
}

}  // namespace camdir::test
