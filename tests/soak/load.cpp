#include "load.hpp"

#include <camera_director/camera_director.hpp>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <iostream>
#include <mutex>

#include "app/number_between.hpp"

namespace camdir::soak {
namespace {

using Clock = std::chrono::steady_clock;

std::vector<camera_director::Match> open_matches(const camera_director::Context& context, const Load& load,
                                                 std::uint32_t player_count) {
    std::vector<camera_director::Match> matches;
    for (std::size_t i = 0; i < load.matches.size(); ++i) {
        camera_director::MatchInfo info;
        info.match_id = load.match_prefix + "-" + std::to_string(i);
        info.map_name = load.map_name;
        info.map_hash = load.map_hash;
        info.metres_per_unit = load.metres_per_unit;
        info.rate_hz = static_cast<float>(load.rate_hz);
        info.spectator_delay_s = static_cast<float>(load.delay_s);
        for (std::uint32_t player = 0; player < player_count; ++player) {
            info.players.push_back({.id = player, .name = "player " + std::to_string(player)});
        }
        matches.push_back(camera_director::Match::open(context, info).value());
    }
    return matches;
}

// The events before the poses that show what they did. Returns how many found no room in the queue.
std::uint64_t publish(camera_director::Match& match, const MatchFrame& frame, std::int64_t frame_time) {
    std::uint64_t lost = 0;
    for (camera_director::MatchEvent event : frame.events) {
        event.frame_time = frame_time;
        const auto sent = match.publish(event);
        if (!sent && sent.error().status() == CDIR_BUSY)
            ++lost;
        else
            sent.value();
    }
    const PoseArrays& poses = frame.poses;
    match
        .publish({.frame_time = frame_time,
                  .player_id = poses.player_id,
                  .eye = poses.eye,
                  .orientation = poses.orientation,
                  .velocity = poses.velocity,
                  .flags = poses.flags})
        .value();
    return lost;
}

// Returns false when a stop was requested.
bool sleep_until(Clock::time_point when, const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any changed;
    std::unique_lock lock(mutex);
    changed.wait_until(lock, stop, when, [] { return false; });
    return !stop.stop_requested();
}

}  // namespace

void Network::add_options(CLI::App& app) {
    app.add_option("--domain", domain, "DDS domain")->check(CLI::Range(0, 230))->capture_default_str();
    app.add_option("--interface", interface, "Network interface")->capture_default_str();
    app.add_option("--directors", directors, "Directors' addresses, separated by commas")
        ->capture_default_str();
    app.add_option("--security", security, "Folder of the identity for DDS Security; without it plain DDS");
}

camera_director::ContextOptions Network::context_options() const {
    return {.domain = domain,
            .network_interface = interface,
            .directors = directors,
            .security = security.empty() ? std::nullopt : std::optional(security)};
}

void Load::add_options(CLI::App& app) {
    app.add_option("--match-prefix", match_prefix, "Matches are PREFIX-0, PREFIX-1, ...")
        ->capture_default_str();
    app.add_option("--speed", speed, "Of the game relative to real time")
        ->check(app::number_between(0.01, 100.0))
        ->capture_default_str();
    app.add_option("--delay", delay_s, "Spectator delay, s")
        ->check(app::number_between(0.0, 600.0))
        ->capture_default_str();
    app.add_option("--seconds", seconds, "Duration; 0: until interrupted")->check(CLI::NonNegativeNumber);
    network.add_options(app);
}

void PoseArrays::clear() {
    player_id.clear();
    flags.clear();
    eye.clear();
    orientation.clear();
    velocity.clear();
}

void MatchFrame::clear() {
    poses.clear();
    events.clear();
}

void PoseArrays::add(std::uint32_t id, const Vec3f& at, const Quatf& looking, const Vec3f& moving,
                     std::uint32_t pose_flags) {
    player_id.push_back(id);
    flags.push_back(pose_flags);
    eye.insert(eye.end(), at.begin(), at.end());
    orientation.insert(orientation.end(), {looking.x(), looking.y(), looking.z(), looking.w()});
    velocity.insert(velocity.end(), moving.begin(), moving.end());
}

int run(const Load& load, std::uint32_t player_count, const std::stop_token& stop) {
    const camera_director::Context context =
        camera_director::Context::open(load.network.context_options()).value();
    std::vector<camera_director::Match> matches = open_matches(context, load, player_count);

    const std::chrono::duration<double> interval(1.0 / load.rate_hz);
    const double game_interval_ns = 1e9 * load.speed / load.rate_hz;
    const Clock::time_point start = Clock::now();
    std::uint64_t late = 0;
    std::uint64_t lost_events = 0;
    MatchFrame frame;
    std::uint64_t number = 0;
    for (;; ++number) {
        const auto due = start + std::chrono::duration_cast<Clock::duration>(number * interval);
        if (load.seconds > 0.0 && due - start >= std::chrono::duration<double>(load.seconds)) break;
        if (!sleep_until(due, stop)) break;
        if (Clock::now() - due > interval) ++late;
        const auto frame_time = std::llround(static_cast<double>(number) * game_interval_ns);
        for (std::size_t i = 0; i < matches.size(); ++i) {
            frame.clear();
            load.matches[i](number, frame);
            lost_events += publish(matches[i], frame, frame_time);
        }
    }

    const double took = std::chrono::duration<double>(Clock::now() - start).count();
    std::cout << "matches " << matches.size() << "\nframes " << number * matches.size() << "\nseconds "
              << took << "\nrate_hz " << static_cast<double>(number) / took << "\nlate_ticks " << late
              << "\nlost_events " << lost_events << '\n';
    return late * 100 > number ? 1 : 0;
}

}  // namespace camdir::soak
