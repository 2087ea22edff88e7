// Shared by the load generators: publishes the poses and events of any number of matches at a constant rate.
#pragma once

#include <CLI/CLI.hpp>
#include <camera_director/camera_director.hpp>
#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::soak {

// How a program reaches the directors: the same options in all programs.
struct Network {
    std::uint32_t domain = 0;
    std::string interface = "lo";
    std::string directors = "127.0.0.1";
    std::string security;  // folder of the identity; empty: plain DDS

    void add_options(CLI::App& app);
    [[nodiscard]] camera_director::ContextOptions context_options() const;
};

// The poses of one frame, in the layout of the SDK.
struct PoseArrays {
    std::vector<std::uint32_t> player_id, flags;
    std::vector<float> eye, orientation, velocity;

    void clear();
    void add(std::uint32_t id, const Vec3f& at, const Quatf& looking, const Vec3f& moving,
             std::uint32_t pose_flags);
};

struct MatchFrame {
    PoseArrays poses;
    std::vector<camera_director::MatchEvent> events;  // that happened in it; `frame_time` is not used

    void clear();
};

// The frames of one match. Called once per frame with `number` counting from 0; fills `frame`, which is
// empty.
using MatchFrames = std::function<void(std::uint64_t number, MatchFrame& frame)>;

struct Load {
    Network network;
    std::string match_prefix = "load";  // matches are called PREFIX-0, PREFIX-1, ...
    std::string map_name;
    std::uint64_t map_hash = 0;
    float metres_per_unit = 0.0254F;
    double rate_hz = 60.0;  // frames sent per second
    double speed = 1.0;     // of the game's clock relative to real time
    double delay_s = 0.0;   // spectator delay
    double seconds = 0.0;   // duration; 0 = until interrupted
    std::vector<MatchFrames> matches;

    // What all load generators are told: the same options, also the network's.
    void add_options(CLI::App& app);
};

// Publishes for load.seconds or until a stop is requested, then prints a summary to standard output, with the
// events for which the library had no room. Returns the exit code: 1 when more than 1 % of the frames were
// over one frame late, that is, the machine is too slow.
[[nodiscard]] int run(const Load& load, std::uint32_t player_count, const std::stop_token& stop);

}  // namespace camdir::soak
