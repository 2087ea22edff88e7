// What the load generators share: matches whose players' poses are published at a steady rate.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::soak {

// How a program reaches the directors; the same options in every program.
struct Network {
    std::uint32_t domain = 0;
    std::string interface = "lo";
    std::string directors = "127.0.0.1";

    void add_options(CLI::App& app);
};

// The poses of one frame, as the SDK wants them.
struct PoseArrays {
    std::vector<std::uint32_t> player_id, flags;
    std::vector<float> eye, orientation, velocity;

    void clear();
    void add(std::uint32_t id, const Vec3f& at, const Quatf& looking, const Vec3f& moving,
             std::uint32_t pose_flags);
};

// One match's players. Called once a frame with ascending `frame`, counted from 0; fills `poses`, which is
// empty.
using Players = std::function<void(std::uint64_t frame, PoseArrays& poses)>;

struct Load {
    Network network;
    std::string match_prefix = "load";  // matches are called PREFIX-0, PREFIX-1, ...
    std::string map_name;
    std::uint64_t map_hash = 0;
    float metres_per_unit = 0.0254F;
    double rate_hz = 60.0;  // frames a second that are sent
    double speed = 1.0;     // of the game's clock against the wall's: rate_hz / speed frames a game second
    double delay_s = 0.0;   // spectator delay
    double seconds = 0.0;   // how long; 0 = until interrupted
    std::vector<Players> matches;
};

// Publishes until the time is over or a stop is requested, then prints a summary to standard output.
// Returns the exit code: 1 when the machine could not keep up with the rate (over 1 % of ticks a frame late).
[[nodiscard]] int run(const Load& load, std::uint32_t player_count, const std::stop_token& stop);

}  // namespace camdir::soak
