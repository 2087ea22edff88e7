// synthetic-players: players that walk along a baked map's roadmap, in any number of matches.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <utility>

#include "app/number_between.hpp"
#include "load.hpp"
#include "program.hpp"
#include "walker.hpp"

namespace camdir::soak {
namespace {

struct Options {
    std::string map;
    std::uint32_t matches = 1;
    std::uint32_t players = 8;
    std::uint32_t seed = 1;
    float clearance = 16.0F;
    WalkStyle style;
    Load load;
};

MatchFrames walk(const Roads& roads, const Options& options, std::uint32_t match) {
    auto walkers = std::make_shared<std::vector<Walker>>();
    for (std::uint32_t player = 0; player < options.players; ++player) {
        walkers->emplace_back(roads, options.style, options.seed + 1000 * match + player);
    }
    const double dt = options.load.speed / options.load.rate_hz;
    return [walkers, dt](std::uint64_t /*number*/, MatchFrame& frame) {
        for (std::uint32_t player = 0; player < walkers->size(); ++player) {
            (*walkers)[player].step(player, dt, frame.poses);
        }
    };
}

int play(Options options, const std::stop_token& stop) {
    const auto map = freespace::Freespace::open(options.map);
    if (!map) {
        std::cerr << "synthetic-players: " << map.error().message << '\n';
        return 1;
    }
    const float scale = 0.0254F / map->metadata().metres_per_unit;
    const Roads roads(*map, options.clearance * scale);
    if (roads.empty()) {
        std::cerr << "synthetic-players: " << options.map << ": no roads of clearance "
                  << options.clearance * scale << '\n';
        return 1;
    }
    options.style.speed *= scale;
    options.load.map_hash = map->metadata().source_hash;
    options.load.metres_per_unit = map->metadata().metres_per_unit;
    if (options.load.map_name.empty()) options.load.map_name = map->metadata().map_name;
    for (std::uint32_t match = 0; match < options.matches; ++match) {
        options.load.matches.push_back(walk(roads, options, match));
    }
    return run(options.load, options.players, stop);
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    using namespace camdir;
    soak::Options options;
    CLI::App app("Players that walk along a baked map's roadmap.", "synthetic-players");
    app.add_option("map", options.map, "Baked map, MAP.vfs")->required();
    app.add_option("--map-name", options.load.map_name,
                   "The map's name in the director's configuration; default: the baked map's");
    app.add_option("--matches", options.matches)->check(CLI::Range(1, 4096))->capture_default_str();
    app.add_option("--players", options.players, "Per match")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    app.add_option("--rate", options.load.rate_hz, "Frames sent per second")
        ->check(app::number_between(0.1, 1000.0))
        ->capture_default_str();
    app.add_option("--stops", options.style.stops_per_s, "Per player and second")
        ->check(app::number_between(0.0, 100.0))
        ->capture_default_str();
    app.add_option("--teleports", options.style.teleports_per_s, "Per player and second")
        ->check(app::number_between(0.0, 100.0))
        ->capture_default_str();
    app.add_option("--clearance", options.clearance, "Least free distance of the roads, units of 0.0254 m")
        ->check(app::number_between(0.1, 1000.0))
        ->capture_default_str();
    app.add_option("--seed", options.seed, "The same seed gives the same poses")->capture_default_str();
    options.load.add_options(app);
    return soak::run_until_interrupted(
        app, argc, argv, [&](const std::stop_token& stop) { return soak::play(std::move(options), stop); });
}
