// For the tests of serve: a hall without obstacles, a server with it as a map, a game in it.
#pragma once

#include <gtest/gtest.h>

#include <camera_director/camera_director.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::test {

// The hall: the plane z = 0 within +-1000 units, with a free distance of 150 units; made without baking.
inline constexpr float hall_half_width = 1000.0F;
inline constexpr float hall_half_height = 150.0F;
void write_hall(const std::filesystem::path& file);

// A running `camera-director serve` with the maps "hall" and "yard", which are both the hall. Those of one
// domain know each other.
class Server {
  public:
    struct Options {
        int participant_index = 0;
        std::int64_t strength = 100;
        std::int64_t director_id = 1;
        double minimum_delay_s = 0.0;
        bool has_yard = true;
        std::string shard = {};
        std::string shards = "[]";   // JSON
        std::string security = {};   // folder of its identity; empty: plain DDS
        std::string recording = {};  // folder; empty: nothing is recorded
    };
    Server(std::uint32_t domain, const Options& options);
    explicit Server(std::uint32_t domain) : Server(domain, Options{}) {}

    [[nodiscard]] ChildProcess& process() { return *process_; }
    [[nodiscard]] std::string log() const { return process_->errors(); }
    [[nodiscard]] bool ready() const;
    // Of what takes effect without a restart.
    void reload(const Options& options);

  private:
    void write_config(const Options& options) const;

    const std::uint32_t domain_;
    TemporaryFolder folder_;
    std::unique_ptr<ChildProcess> process_;
};

// The SDK's options for directors on this machine with participant indices 0 and 1.
[[nodiscard]] camera_director::ContextOptions connection(std::uint32_t domain);

// A game server in this process: players walk in circles in the hall, at 60 frames per second. Epoch 0:
// chosen by the SDK.
class Game {
  public:
    Game(const camera_director::Context& context, const std::string& match_id, const std::string& map_name,
         std::uint32_t players = 4, std::uint64_t epoch = 0);
    ~Game();

    void change_map(const std::string& map_name, std::uint32_t players = 4);

  private:
    void publish(std::uint32_t frame);

    std::mutex mutex_;
    camera_director::MatchInfo info_;
    camera_director::Match match_;
    std::uint32_t frames_ = 0;
    std::jthread thread_;
};

// Takes frames until `wanted` returns true for a frame and its cameras; false when none did in time.
using FrameTest =
    std::function<bool(const camera_director::CameraFrame&, std::span<const camera_director::Camera>)>;
[[nodiscard]] bool sees(camera_director::Observer& observer, const FrameTest& wanted);

// Whether it waited for the reader for about as long as it is kept: those before it may have waited longer.
[[nodiscard]] bool came_late(const camera_director::CameraFrame& frame);

// A frame with the observer's own camera arrives.
[[nodiscard]] bool sees_own_camera(camera_director::Observer& observer);

// The next `frames` frames come from this director, with the observer's own camera, each newer than the one
// before, and none is lost on its way.
[[nodiscard]] testing::AssertionResult serves_on(camera_director::Observer& observer,
                                                 std::uint64_t director_id, int frames);

// The observer's shot reaches this state (CDIR_SHOT_...).
[[nodiscard]] bool comes_to(camera_director::Observer& observer, std::uint32_t state);

}  // namespace camdir::test
