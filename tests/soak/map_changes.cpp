// Many map changes and restarts under a live OpenArena server with bots and spectators. Prints a table; exits
// with 1 when a process ends, a life of a map is not served or not drawn, or one that is not baked is not
// named.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "support/game/camera_tape.hpp"
#include "support/game/director.hpp"
#include "support/game/game_client.hpp"
#include "support/game/game_server.hpp"
#include "support/game/packages.hpp"
#include "support/program.hpp"
#include "support/test_domain.hpp"

namespace camdir::soak {
namespace {

using namespace camdir::test;

constexpr int bots = 8;
const std::vector<std::string> baked = {"oa_dm1", "aggressor"};
const std::string not_baked = "oa_dm3";

struct Options {
    int changes = 100;
    int rate = 20;
    int spectators = 2;
};

struct Footprint {
    double megabytes;  // resident
    std::size_t threads, descriptors;
};

Footprint footprint_of(pid_t process) {
    const std::filesystem::path folder = "/proc/" + std::to_string(process);
    const auto count = [&](const char* name) {
        std::error_code error;  // an entry may go while it is read
        const std::filesystem::directory_iterator entries(folder / name, error);
        return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
    };
    double size = 0, resident = 0;
    std::ifstream(folder / "statm") >> size >> resident;
    constexpr double page = 4096, megabyte = 1e6;
    return {resident * page / megabyte, count("task"), count("fd")};
}

class Match {
  public:
    explicit Match(const Options& options)
        : director_(domain_.id(), baked),
          server_({.map = baked.front(),
                   .rate = options.rate,
                   .bots = bots,
                   .settings = {{"director_domain", std::to_string(domain_.id())}}}),
          tape_(domain_.id(), "openarena-" + std::to_string(server_.port())) {
        expect(server_.ready(bots), "the server's bots do not join");
        for (int i = 0; i < options.spectators; ++i) {
            clients_.emplace_back(
                server_.port(),
                GameClientOptions{.name = "watcher" + std::to_string(i), .width = 320, .height = 180});
        }
        expect_drawn();
    }

    // Changes the map, or restarts it without a name. Returns the milliseconds until the new life had a
    // camera, from its first frame with a spectator on; none when its map is not baked.
    std::optional<double> change(const std::string& map) {
        const auto before = lives();
        const auto epoch = newest_epoch();
        server_.console().enter(map.empty() ? "map_restart 0" : "map " + map);
        expect(eventually([&] { return lives() > before || !server_.console().runs(); }), "no new life");
        expect(server_.reaches([](const witness_record& /*frame*/) { return true; }), "no frame");
        if (map == not_baked) {
            const std::string reason = "'" + not_baked + "' is not configured";
            expect(eventually([&] { return status().find(reason) != std::string::npos; }),
                   "no reason why there is no camera");
            return std::nullopt;
        }
        fill_up();
        const auto begin = first_frame_with_a_spectator();
        std::optional<double> served;
        expect(eventually([&] {
                   served = served_after(epoch, begin);
                   return served.has_value();
               }),
               "no camera");
        expect_drawn();
        return served;
    }

    [[nodiscard]] Footprint server_footprint() { return footprint_of(server_.console().pid()); }
    [[nodiscard]] Footprint director_footprint() { return footprint_of(director_.pid()); }
    [[nodiscard]] std::string status() { return server_.console().ask("director status"); }

  private:
    void expect(bool holds, const std::string& otherwise) {
        if (holds) return;
        throw std::runtime_error(otherwise + "\nserver:\n" + server_.console().output() + "director:\n" +
                                 director_.log());
    }

    std::ptrdiff_t lives() {
        const auto& records = server_.witnessed();
        return std::count_if(records.begin(), records.end(), is_start);
    }

    std::uint64_t newest_epoch() {
        const auto entries = tape_.entries();
        return entries.empty() ? 0 : entries.back().epoch;
    }

    static bool is_start(const witness_record& record) { return record.kind == witness_starts; }

    static int players(const witness_record& frame) {
        return static_cast<int>(
            std::count_if(std::begin(frame.players), std::end(frame.players),
                          [](const witness_player& player) { return player.bot && player.in_game; }));
    }

    // Bots leave with a map, and stay at a restart.
    void fill_up() {
        const int present = players(*server_.newest());
        server_.add_bots(std::max(0, bots - present));
        expect(server_.reaches([](const witness_record& frame) { return players(frame) >= bots; }),
               "the bots do not join");
    }

    // Clients load a new map before they enter it.
    std::int64_t first_frame_with_a_spectator() {
        const auto is_entered = [](const witness_record& frame) {
            return frame.kind == witness_ran_frame &&
                   std::any_of(std::begin(frame.players), std::end(frame.players),
                               [](const witness_player& player) {
                                   return player.connected && !player.bot && player.in_game;
                               });
        };
        std::int64_t time = 0;
        expect(eventually([&] {
                   const auto& records = server_.witnessed();
                   const auto start = std::find_if(records.rbegin(), records.rend(), is_start).base();
                   const auto entered = std::find_if(start, records.end(), is_entered);
                   if (entered != records.end()) time = entered->time;
                   return time != 0;
               }),
               "no spectator enters");
        return time;
    }

    std::optional<double> served_after(std::uint64_t previous_epoch, std::int64_t begin) {
        const auto entries = tape_.entries();
        const auto entry = std::find_if(entries.begin(), entries.end(),
                                        [&](const CameraTape::Entry& e) { return e.epoch > previous_epoch; });
        if (entry == entries.end()) return std::nullopt;
        constexpr double ms = 1e6;
        return static_cast<double>(entry->received - begin) / ms;
    }

    void expect_drawn() {
        for (GameClient& client : clients_)
            expect(client.draws(5), "a spectator draws nothing:\n" + client.console().output());
    }

    TestDomain domain_;
    GameDirector director_;
    GameServer server_;
    CameraTape tape_;
    std::deque<GameClient> clients_;
};

std::string map_of(int change) {
    constexpr int period = 10, at_restarts = 2, at_the_end = 9;
    if (change % period == at_the_end) return not_baked;
    if (change % at_restarts == 0)
        return baked[static_cast<std::size_t>(change / at_restarts) % baked.size()];
    return "";
}

void print_row(int change, Match& match, double slowest) {
    const Footprint server = match.server_footprint(), director = match.director_footprint();
    std::printf("| %d | %.0f | %.1f | %zu | %zu | %.1f | %zu | %zu |\n", change, slowest, server.megabytes,
                server.threads, server.descriptors, director.megabytes, director.threads,
                director.descriptors);
    std::fflush(stdout);
}

void run(const Options& options) {
    Match match(options);
    std::puts(
        "| changes | slowest camera for a spectator, ms | server, MB | threads | descriptors | director, MB "
        "| threads | descriptors |\n|---|---|---|---|---|---|---|---|");
    print_row(0, match, 0.0);
    constexpr int row = 10;
    double slowest = 0.0;
    for (int change = 0; change < options.changes; ++change) {
        slowest = std::max(slowest, match.change(map_of(change)).value_or(0.0));
        if ((change + 1) % row != 0) continue;
        print_row(change + 1, match, slowest);
        slowest = 0.0;
    }
    std::cout << "\n" << match.status();
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    CLI::App app("Changes the map under a live OpenArena match with spectators. Prints a table.");
    camdir::soak::Options options;
    app.add_option("--changes", options.changes, "map changes and restarts")->capture_default_str();
    app.add_option("--rate", options.rate, "server frames per second")->capture_default_str();
    app.add_option("--spectators", options.spectators, "clients that watch")
        ->check(CLI::Range(1, 7))
        ->capture_default_str();
    return camdir::test::run_program(app, argc, argv, [&] {
        if (const auto needs = camdir::test::needs_game_package()) throw std::runtime_error(*needs);
        camdir::soak::run(options);
        return 0;
    });
}
