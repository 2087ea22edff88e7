#include "hall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "base/file.hpp"
#include "freespace/freespace.hpp"
#include "support/eventually.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {

void write_hall(const std::filesystem::path& file) {
    constexpr float w = hall_half_width;
    constexpr float h = hall_half_height;
    freespace::Contents hall;
    hall.metadata.map_name = file.stem().string();
    hall.metadata.source_name = "made for a test";
    hall.metadata.metres_per_unit = 0.0254F;
    hall.metadata.d0 = 16.0F;
    hall.metadata.parameters = "{}";
    hall.vertices = {{-w, -w, 0.0F, h}, {w, -w, 0.0F, h}, {w, w, 0.0F, h}, {-w, w, 0.0F, h}};
    hall.triangles = {{0, 1, 2}, {0, 2, 3}};
    hall.spawn_points = {{Vec3f::Zero(), 0.0F}};
    if (const auto written = write_file(file, freespace::encode(hall)); !written) {
        throw std::runtime_error(written.error().message);
    }
}

Server::Server(std::uint32_t domain, const Options& options) : domain_(domain) {
    write_hall(folder_ / "hall.vfs");
    if (options.has_yard) write_hall(folder_ / "yard.vfs");
    write_config(options);
    process_ = std::make_unique<ChildProcess>(std::vector<std::string>{
        CAMDIR_BIN_DIR "/camera-director", "serve", "--config", (folder_ / "config.json").string()});
}

void Server::write_config(const Options& options) const {
    // A lease long enough for a busy machine, and shorter than the stops of these tests.
    std::ofstream(folder_ / "config.json")
        << R"({"dds": {"domain": )" << domain_ << R"(, "participant_index": )" << options.participant_index
        << R"(, "strength": )" << options.strength << R"(, "director_id": )" << options.director_id
        << R"(, "lease_ms": 2500, "shard": ")" << options.shard << R"(", "shards": )" << options.shards
        << R"(, "peers": [")" << director_address(domain_, 1 - options.participant_index)
        << R"("], "security": ")" << options.security << R"("},
        "http": {"enabled": false}, "recording": {"folder": ")"
        << options.recording << R"("},
        "matches": {"minimum_delay_s": )"
        << options.minimum_delay_s << R"(},
        "maps": [{"name": "hall", "file": "hall.vfs"}, {"name": "yard", "file": "yard.vfs"}]})";
}

void Server::reload(const Options& options) {
    write_config(options);
    process_->send_signal(SIGHUP);
}

bool Server::ready() const {
    return eventually([&] { return log().find("ready") != std::string::npos; });
}

camera_director::ContextOptions connection(std::uint32_t domain) {
    return {.domain = domain, .directors = director_address(domain, 0) + ", " + director_address(domain, 1)};
}

namespace {

camera_director::MatchInfo info_of(const std::string& match_id, const std::string& map_name,
                                   std::uint32_t players, std::uint64_t epoch) {
    camera_director::MatchInfo info;
    info.epoch = epoch;
    info.match_id = match_id;
    info.map_name = map_name;
    for (std::uint32_t player = 0; player < players; ++player) {
        info.players.push_back({.id = player, .name = "player " + std::to_string(player)});
    }
    return info;
}

}  // namespace

Game::Game(const camera_director::Context& context, const std::string& match_id, const std::string& map_name,
           std::uint32_t players, std::uint64_t epoch)
    : info_(info_of(match_id, map_name, players, epoch)),
      match_(camera_director::Match::open(context, info_).value()) {
    thread_ = std::jthread([this](const std::stop_token& stop) {
        auto due = std::chrono::steady_clock::now();
        while (!stop.stop_requested()) {
            {
                const std::lock_guard lock(mutex_);
                publish(frames_++);
            }
            due += std::chrono::microseconds(16'667);
            std::this_thread::sleep_until(due);
        }
    });
}

Game::~Game() = default;

void Game::change_map(const std::string& map_name, std::uint32_t players) {
    const std::lock_guard lock(mutex_);
    info_ = info_of(info_.match_id, map_name, players, 0);
    match_.restart(info_).value();
    frames_ = 0;
}

void Game::publish(std::uint32_t frame) {
    std::vector<std::uint32_t> ids, flags;
    std::vector<float> eyes, orientations;
    const float time = static_cast<float>(frame) / 60.0F;
    for (const camera_director::Player& player : info_.players) {
        const float radius = 200.0F + 50.0F * static_cast<float>(player.id);
        const float angle = time + static_cast<float>(player.id);
        const float heading = angle + std::acos(0.0F);  // along the circle
        ids.push_back(player.id);
        flags.push_back(CDIR_POSE_ALIVE);
        eyes.insert(eyes.end(), {radius * std::cos(angle), radius * std::sin(angle), 0.0F});
        orientations.insert(orientations.end(), {0.0F, 0.0F, std::sin(heading / 2), std::cos(heading / 2)});
    }
    match_
        .publish({.frame_time = std::int64_t{16'666'667} * frame,
                  .player_id = ids,
                  .eye = eyes,
                  .orientation = orientations,
                  .flags = flags})
        .value();
}

bool sees(camera_director::Observer& observer, const FrameTest& wanted) {
    std::array<camera_director::Camera, CDIR_MAX_CAMERAS> cameras;
    return eventually([&] {
        while (const auto frame = observer.next_frame(cameras).value()) {
            if (wanted(*frame, std::span(cameras).first(frame->camera_count))) return true;
        }
        return false;
    });
}

bool sees_own_camera(camera_director::Observer& observer) {
    return sees(observer, [&](const auto& /*frame*/, auto cameras) {
        const auto status = observer.shot_status().value();
        if (status.state != CDIR_SHOT_ACCEPTED) return false;
        for (const auto& camera : cameras) {
            if (camera.camera_id == status.camera_id) return true;
        }
        return false;
    });
}

bool came_late(const camera_director::CameraFrame& frame) {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return now - std::chrono::nanoseconds(frame.write_time) > std::chrono::milliseconds(300);
}

testing::AssertionResult serves_on(camera_director::Observer& observer, std::uint64_t director_id,
                                   int frames) {
    testing::AssertionResult result = testing::AssertionSuccess();
    std::optional<camera_director::CameraFrame> last;
    const bool came = sees(observer, [&](const auto& frame, auto cameras) {
        const auto status = observer.shot_status().value();
        const bool own = std::ranges::any_of(
            cameras, [&](const auto& camera) { return camera.camera_id == status.camera_id; });
        if (frame.director_id != director_id)
            result = testing::AssertionFailure() << "director " << frame.director_id;
        else if (status.state != CDIR_SHOT_ACCEPTED || !own)
            result = testing::AssertionFailure() << "no camera, state " << status.state;
        else if (last && frame.frame_time <= last->frame_time)
            result = testing::AssertionFailure() << "a frame of an earlier time";
        else if (last && frame.frame_number != last->frame_number + 1 && !came_late(frame))
            result = testing::AssertionFailure()
                     << "no frames between " << last->frame_number << " and " << frame.frame_number;
        last = frame;
        return !result || --frames == 0;
    });
    return came ? result : testing::AssertionFailure() << "the frames end, " << frames << " early";
}

bool comes_to(camera_director::Observer& observer, std::uint32_t state) {
    return eventually([&] {
        observer.poll().value();
        return observer.shot_status().value().state == state;
    });
}

}  // namespace camdir::test
