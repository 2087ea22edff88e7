#include "hand_over_stage.hpp"

#include <algorithm>
#include <fstream>
#include <iostream>

#include "support/eventually.hpp"

namespace camdir::soak {
namespace {

using std::chrono::milliseconds;
using test::ChildProcess;

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

bool StepClock::available() {
    return std::filesystem::exists(CAMDIR_FAKETIME);
}

StepClock::StepClock(std::filesystem::path file) : file_(std::move(file)) {
    step(std::chrono::seconds(0));
}

std::vector<std::string> StepClock::command(std::vector<std::string> command) const {
    const std::vector<std::string> clock{"/usr/bin/env", "LD_PRELOAD=" CAMDIR_FAKETIME,
                                         "FAKETIME_TIMESTAMP_FILE=" + file_.string(), "FAKETIME_NO_CACHE=1",
                                         "FAKETIME_DONT_FAKE_MONOTONIC=1"};
    command.insert(command.begin(), clock.begin(), clock.end());
    return command;
}

// Never half a file.
void StepClock::step(std::chrono::seconds by) const {
    const std::filesystem::path next = file_.string() + ".next";
    std::ofstream(next) << (by.count() < 0 ? "" : "+") << by.count() << '\n';
    std::filesystem::rename(next, file_);
}

Stage::Stage(const Options& options, const evaluation::Trace& trace, Hosts* hosts, bool steps_clocks)
    : options_(options), hosts_(hosts), record_(trace, rate_hz, player) {
    if (steps_clocks) {
        leader_clock.emplace(folder_ / "leader.time");
        game_clock.emplace(folder_ / "game.time");
    }
    leader.emplace(setting(0));
    standby.emplace(setting(1));
}

Stage::~Stage() {
    reading_ = {};
}

DirectorProcess::Setting Stage::setting(int index) const {
    const std::vector<std::string> program{options_.programs + "/camera-director"};
    return {.command = index == 0 && leader_clock ? leader_clock->command(program) : program,
            .folder = folder_.path(),
            .domain = domain_.id(),
            .index = index,
            .peer = address_of(1 - index),
            .interface = interface_of(index == 0 ? leaders : standbys),
            .insecure = true};
}

std::string Stage::interface_of(Host host) const {
    return hosts_ ? Hosts::interface(host) : "lo";
}

std::string Stage::address_of(int director) const {
    const std::string host = hosts_ ? Hosts::address(director == 0 ? leaders : standbys) : "127.0.0.1";
    return test::director_address(domain_.id(), director, host);
}

void Stage::start(DirectorProcess& director, Host host, const std::string& map, const std::string& source) {
    if (!hosts_) return director.start(map, source);
    hosts_->run_on(host, [&] { director.start(map, source); });
}

void Stage::start_game() {
    game.reset();
    const std::vector<std::string> command{options_.programs + "/pose-replay",
                                           options_.trace,
                                           "--domain",
                                           std::to_string(domain_.id()),
                                           "--interface",
                                           interface_of(clients),
                                           "--directors",
                                           directors(),
                                           "--match-prefix",
                                           "game",
                                           "--map-name",
                                           "map",
                                           "--rate",
                                           "60",
                                           "--delay",
                                           std::to_string(options_.delay_s)};
    game = std::make_unique<ChildProcess>(game_clock ? game_clock->command(command) : command);
}

void Stage::start_observer() {
    context_ =
        camera_director::Context::open(
            {.domain = domain_.id(), .network_interface = interface_of(clients), .directors = directors()})
            .value();
    observer_ = camera_director::Observer::open(*context_, "game-0", "viewer").value();
    observer_->request({.target = player}).value();
    reading_ = std::jthread([this](const std::stop_token& stop) { read(stop); });
}

void Stage::await_leader() {
    const bool served = test::eventually([&] { return serving_director() == DirectorProcess::id_of(0); });
    if (!served) std::cerr << "the leader does not serve\n" << leader->log();
}

void Stage::begin() {
    const std::lock_guard lock(mutex_);
    record_.begin(now());
}

HandOver Stage::finish() {
    const std::lock_guard lock(mutex_);
    return record_.finish(now());
}

std::optional<std::uint64_t> Stage::serving_director() {
    const std::lock_guard lock(mutex_);
    return record_.director();
}

void Stage::pause_observer(milliseconds duration) {
    const std::lock_guard lock(mutex_);
    std::this_thread::sleep_for(duration);
}

void Stage::cut(const std::vector<Way>& ways, milliseconds duration) {
    for (const Way& way : ways)
        hosts_->cut(way.from, way.to);
    std::this_thread::sleep_for(duration);
    for (const Way& way : ways)
        hosts_->join(way.from, way.to);
}

void Stage::read(const std::stop_token& stop) {
    std::vector<camera_director::Camera> cameras(CDIR_MAX_CAMERAS);
    while (!stop.stop_requested()) {
        if (observer_->wait(milliseconds(100)).value() != camera_director::Waited::arrived) continue;
        const std::lock_guard lock(mutex_);
        while (const auto frame = observer_->next_frame(cameras).value()) {
            const auto status = observer_->shot_status().value();
            const auto end = cameras.begin() + frame->camera_count;
            const auto own = std::find_if(cameras.begin(), end, [&](const auto& camera) {
                return camera.camera_id == status.camera_id;
            });
            record_.add(*frame, status.camera_id == 0 || own == end ? nullptr : &*own, now());
        }
    }
}

}  // namespace camdir::soak
