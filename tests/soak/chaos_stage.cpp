#include "chaos_stage.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "support/eventually.hpp"
#include "usage.hpp"

namespace camdir::soak {
namespace {

using test::ChildProcess;

constexpr const char* match_prefix = "real";
// After which a director that has come back knows all there is to know, beside the delay.
constexpr double learning_s = 3.0;
// Short: within a scenario what strangers leave behind is gone.
constexpr double forget_s = 5.0;

// Waits until it has ended, or ends it at a stop. Throws when it failed.
void await_end(ChildProcess& process, const std::string& name, const std::stop_token& stop) {
    std::optional<int> code;
    while (!code && !stop.stop_requested())
        code = process.wait_for(std::chrono::milliseconds(50));
    if (code && *code != 0)
        throw std::runtime_error(name + ": exit code " + std::to_string(*code) + ": " + process.errors());
}

// The number after a word in `text`.
std::uint64_t number_after(const std::string& text, const std::string& word) {
    std::istringstream words(text);
    std::uint64_t number = 0;
    for (std::string found; words >> found;)
        if (found == word) words >> number;
    return number;
}

}  // namespace

void sleep_for(double seconds, const std::stop_token& stop) {
    const auto limit = std::chrono::milliseconds(std::llround(1e3 * seconds));
    (void)test::eventually([&] { return stop.stop_requested(); }, limit);
}

ChaosStage::ChaosStage(const Options& options, const Scenario& scenario)
    : options_(options), scenario_(scenario), places_(static_cast<std::size_t>(scenario.directors)) {
    for (std::size_t i = 0; i < places_.size(); ++i) {
        const int index = static_cast<int>(i);
        places_[i].director.emplace(
            DirectorProcess::Setting{.command = {options_.programs + "/camera-director"},
                                     .folder = folder_.path(),
                                     .domain = domain_.id(),
                                     .index = index,
                                     .peer = test::director_address(domain_.id(), 1 - index),
                                     .forget_s = forget_s});
        start(places_[i]);
    }
    start_game();
    start_witness();
    if (!test::eventually([&] { return witness_->all_are_served(); }))
        throw std::runtime_error("not all observers are served\n" + game_->errors() + logs());
}

void ChaosStage::start(Place& place) {
    place.director->start(options_.map, "");
    {
        const std::lock_guard lock(processes_);
        place.process = place.director->pid();
    }
    if (!test::eventually([&] { return place.director->is_ready(); }))
        throw std::runtime_error("a director does not get ready\n" + place.director->log());
}

void ChaosStage::start_game() {
    game_ = std::make_unique<ChildProcess>(std::vector<std::string>{options_.programs + "/synthetic-players",
                                                                    options_.map,
                                                                    "--domain",
                                                                    std::to_string(domain_.id()),
                                                                    "--directors",
                                                                    directors(),
                                                                    "--map-name",
                                                                    "map",
                                                                    "--match-prefix",
                                                                    match_prefix,
                                                                    "--matches",
                                                                    std::to_string(scenario_.matches),
                                                                    "--players",
                                                                    std::to_string(scenario_.players),
                                                                    "--rate",
                                                                    std::to_string(scenario_.rate_hz),
                                                                    "--delay",
                                                                    std::to_string(scenario_.delay_s),
                                                                    "--seed",
                                                                    std::to_string(scenario_.seed),
                                                                    "--teleports",
                                                                    "0"});
}

void ChaosStage::start_witness() {
    witness_ = std::make_unique<Witness>(
        Witness::Options{.domain = domain_.id(),
                         .directors = directors(),
                         .match_prefix = match_prefix,
                         .matches = static_cast<std::uint32_t>(scenario_.matches),
                         .observers = static_cast<std::uint32_t>(scenario_.observers),
                         .players = static_cast<std::uint32_t>(scenario_.players),
                         .delay_s = scenario_.delay_s});
}

ActRecord ChaosStage::perform(const Act& act, const std::function<double()>& now,
                              const std::stop_token& stop) {
    ActRecord record;
    record.act = act;
    std::unique_lock acting(acting_, std::defer_lock);
    if (is_done_to_director(act.kind)) acting.lock();
    record.begin = now();
    try {
        if (is_done_to_director(act.kind))
            act_on_director(act, stop);
        else
            act_as_stranger(record, stop);
    } catch (const std::exception& error) {
        record.failure = error.what();
    }
    record.end = now();
    if (acting) sleep_for(learning_s + scenario_.delay_s, stop);
    return record;
}

ChaosStage::Place& ChaosStage::place_of(Role role) {
    const bool second_leads = witness_->director() == DirectorProcess::id_of(1);
    const bool second = second_leads == (role == Role::leader);
    return places_.at(second ? 1 : 0);
}

void ChaosStage::act_on_director(const Act& act, const std::stop_token& stop) {
    Place& place = place_of(act.director);
    switch (act.kind) {
        case ActKind::hand_over:
            // It keeps those of strangers for which no standby has cameras.
            (void)place.director->hand_over();
            return;
        case ActKind::reload:
            return place.director->signal(SIGHUP);
        case ActKind::pause:
            place.director->signal(SIGSTOP);
            sleep_for(act.for_s, stop);
            return place.director->signal(SIGCONT);
        default:
            restart(place, act, stop);
    }
}

void ChaosStage::act_as_stranger(ActRecord& record, const std::stop_token& stop) {
    if (record.act.kind == ActKind::slow_observer) return freeze_observer(record.act, stop);
    if (record.act.kind == ActKind::crowd) return run_crowd(record, stop);
    record.invented = run_stranger(record.act, stop);
}

void ChaosStage::restart(Place& place, const Act& act, const std::stop_token& stop) {
    place.director->signal(act.kind == ActKind::kill ? SIGKILL : SIGTERM);
    const int code = place.director->wait();
    {
        const std::lock_guard lock(processes_);
        place.process = 0;
    }
    if (act.kind == ActKind::terminate && code != 0)
        throw std::runtime_error("after SIGTERM: exit code " + std::to_string(code) + ": " +
                                 place.director->log());
    sleep_for(act.for_s, stop);
    start(place);
}

void ChaosStage::freeze_observer(const Act& act, const std::stop_token& stop) {
    const ChildProcess observer({options_.programs + "/observer-probe", "--domain",
                                 std::to_string(domain_.id()), "--directors", directors(), "--match-prefix",
                                 match_prefix, "--matches", std::to_string(scenario_.matches), "--observers",
                                 std::to_string(scenario_.observers)});
    sleep_for(std::min(1.0, act.for_s / 2.0), stop);  // it is served
    observer.send_signal(SIGSTOP);
    sleep_for(act.for_s, stop);
}

std::uint64_t ChaosStage::run_stranger(const Act& act, const std::stop_token& stop) {
    const auto seed = static_cast<std::uint32_t>(scenario_.seed) + ++strangers_;
    ChildProcess stranger({options_.programs + "/stranger", name_of(act.kind), "--domain",
                           std::to_string(domain_.id()), "--match", std::string(match_prefix) + "-0",
                           "--seconds", std::to_string(act.for_s), "--count", std::to_string(act.count),
                           "--batch", std::to_string(act.batch), "--seed", std::to_string(seed)});
    await_end(stranger, "stranger", stop);
    return number_after(stranger.output(), "answered");
}

void ChaosStage::run_crowd(ActRecord& record, const std::stop_token& stop) {
    const Act& act = record.act;
    std::vector<std::unique_ptr<ChildProcess>> processes;
    for (std::int64_t first = 0; first < act.count; first += act.batch) {
        processes.push_back(std::make_unique<ChildProcess>(std::vector<std::string>{
            options_.programs + "/crowd", "--domain", std::to_string(domain_.id()), "--directors",
            directors(), "--match-prefix", match_prefix, "--matches", std::to_string(scenario_.matches),
            "--players", std::to_string(scenario_.players), "--first", std::to_string(first), "--count",
            std::to_string(std::min(act.batch, act.count - first)), "--seconds", std::to_string(act.for_s)}));
    }
    for (const auto& process : processes) {
        await_end(*process, "crowd", stop);
        record.invented += number_after(process->output(), "answered");
        const double waited_ms = static_cast<double>(number_after(process->output(), "longest_wait_ms"));
        record.waited_s = std::max(record.waited_s, 1e-3 * waited_ms);
    }
}

std::array<std::optional<Usage>, 2> ChaosStage::usages() {
    std::array<std::optional<Usage>, 2> usages;
    const std::lock_guard lock(processes_);
    for (std::size_t i = 0; i < places_.size(); ++i)
        if (places_[i].process != 0) usages[i] = usage_of(places_[i].process);
    return usages;
}

std::string ChaosStage::end() {
    const std::lock_guard lock(acting_);
    std::string problems;
    for (Place& place : places_) {
        place.director->signal(SIGTERM);
        const int code = place.director->wait();
        if (code != 0) problems += "exit code " + std::to_string(code) + ": " + place.director->log();
    }
    // Not killed: a sanitizer looks for leaks at the end. That it was too slow at times is no problem.
    game_->send_signal(SIGTERM);
    game_->wait();
    return problems;
}

std::string ChaosStage::logs() {
    std::string all;
    for (std::size_t i = 0; i < places_.size(); ++i)
        all += "-- director " + std::to_string(i) + '\n' + places_[i].director->log();
    return all;
}

std::string ChaosStage::directors() const {
    return test::director_address(domain_.id(), 0) + ", " + test::director_address(domain_.id(), 1);
}

}  // namespace camdir::soak
