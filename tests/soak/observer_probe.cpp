// observer-probe: observers that check the cameras that they receive.
#include <unistd.h>
#include <CLI/CLI.hpp>

#include <atomic>
#include <chrono>
#include <iostream>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/file.hpp"
#include "findings_table.hpp"
#include "load.hpp"
#include "oracle/oracle.hpp"
#include "program.hpp"
#include "scene/load.hpp"
#include "shot_checker.hpp"

namespace camdir::soak {
namespace {

struct Options {
    Network network;
    std::string match_prefix = "load";
    std::uint32_t matches = 1;
    std::uint32_t observers = 1;
    bool automatic = false;
    bool by_player = false;
    std::string profile;
    std::string map;
    double seconds = 0.0;
    double grace = 30.0;
    Limits limits;
    std::uint64_t max_gaps = 0;
    std::uint64_t max_violations = 0;
    double max_p99_ms = 0.0;
    double min_rate = 0.0;
    std::string json;
};

std::int64_t realtime_now() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

// One observer of one match, with its own thread, so that latencies are measured when a frame arrives.
class Probe {
  public:
    Probe(const camera_director::Context& context, const Options& options, const oracle::Oracle* oracle,
          std::uint32_t match, std::uint32_t number)
        : observer_(camera_director::Observer::open(context,
                                                    options.match_prefix + "-" + std::to_string(match),
                                                    "probe-" + std::to_string(number))
                        .value()),
          checker_(oracle, options.limits) {
        observer_
            .request({.target = options.automatic ? CDIR_CHOOSE_TARGET : number, .profile = options.profile})
            .value();
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
    ~Probe() {
        thread_.request_stop();
        observer_.interrupt().value();
    }

    // Resets the findings; the previous frame is kept.
    void restart() {
        const std::lock_guard lock(mutex_);
        checker_.findings() = {};
    }
    [[nodiscard]] Findings findings() const {
        const std::lock_guard lock(mutex_);
        return checker_.findings();
    }
    [[nodiscard]] std::optional<camera_director::Camera> latest() const {
        const std::lock_guard lock(mutex_);
        return checker_.latest();
    }
    [[nodiscard]] camera_director::ShotStatus status() const { return observer_.shot_status().value(); }

  private:
    void run(const std::stop_token& stop) {
        std::vector<camera_director::Camera> cameras(CDIR_MAX_CAMERAS);
        while (!stop.stop_requested()) {
            if (observer_.wait(std::chrono::milliseconds(200)).value() != camera_director::Waited::arrived)
                continue;
            while (const auto frame = observer_.next_frame(cameras).value()) {
                const std::int64_t received = realtime_now();
                const auto* own = own_camera(std::span(cameras).first(frame->camera_count));
                const std::lock_guard lock(mutex_);
                checker_.check(*frame, own, received);
                checker_.findings().invalid = observer_.counters().value().invalid;
            }
        }
    }

    [[nodiscard]] const camera_director::Camera* own_camera(
        std::span<const camera_director::Camera> cameras) const {
        const auto status = observer_.shot_status().value();
        if (status.state != CDIR_SHOT_ACCEPTED) return nullptr;
        for (const camera_director::Camera& camera : cameras) {
            if (camera.camera_id == status.camera_id) return &camera;
        }
        return nullptr;
    }

    camera_director::Observer observer_;
    mutable std::mutex mutex_;
    ShotChecker checker_;
    std::jthread thread_;
};

using Probes = std::vector<std::unique_ptr<Probe>>;

// The sum over `count` probes.
Findings sum(const Probes& probes, std::size_t first, std::size_t count) {
    Findings total;
    for (std::size_t i = first; i < first + count; ++i)
        total.add(probes[i]->findings());
    return total;
}

double milliseconds(double seconds) {
    return 1e3 * seconds;
}

std::vector<Row> rows_of(const Probes& probes, const Options& options) {
    std::vector<Row> rows;
    if (options.by_player) {
        for (std::size_t i = 0; i < probes.size(); ++i) {
            const std::string match = options.matches > 1 ? std::to_string(i / options.observers) + "/" : "";
            rows.push_back({match + std::to_string(i % options.observers), 1, probes[i]->findings(),
                            probes[i]->latest()});
        }
        return rows;
    }
    for (std::size_t match = 0; match < options.matches; ++match) {
        rows.push_back({options.match_prefix + "-" + std::to_string(match), options.observers,
                        sum(probes, match * options.observers, options.observers), std::nullopt});
    }
    return rows;
}

// Observers without a camera, each with the director's answer.
std::vector<std::string> unserved(const Probes& probes) {
    std::vector<std::string> list;
    for (std::size_t i = 0; i < probes.size(); ++i) {
        if (probes[i]->findings().cameras > 0) continue;
        const auto status = probes[i]->status();
        list.push_back("observer " + std::to_string(i) + ": state " + std::to_string(status.state) + " " +
                       status.reason);
    }
    return list;
}

nlohmann::json to_json(const Latencies& latencies) {
    return {{"p50", milliseconds(latencies.percentile(0.5))},
            {"p99", milliseconds(latencies.percentile(0.99))},
            {"p999", milliseconds(latencies.percentile(0.999))},
            {"max", milliseconds(latencies.largest())}};
}

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

nlohmann::json to_json(const Findings& total, const Options& options, Clock::time_point start, double seconds,
                       const std::vector<std::string>& violations) {
    const double frames = static_cast<double>(total.frames);
    const double start_s = std::chrono::duration<double>(start.time_since_epoch()).count();
    return {{"matches", options.matches},
            {"observers", options.observers * options.matches},
            {"start_s", start_s},  // of the monotonic clock
            {"seconds", seconds},
            {"frames", total.frames},
            {"frames_per_second", frames / (options.observers * options.matches) / seconds},
            {"cameras", total.cameras},
            {"gaps", total.gaps},
            {"disorder", total.disorder},
            {"delay_s", options.limits.delay},
            {"early", total.early},
            {"hand_overs", total.hand_overs},
            {"epochs", total.epochs},
            {"invalid", total.invalid},
            {"lateness_ms", to_json(total.lateness)},
            {"latency_ms", to_json(total.latency)},
            {"flags",
             {{"cut", total.cuts},
              {"target_visible", total.visible},
              {"searching", total.searching},
              {"target_absent", total.absent},
              {"held", total.held}}},
            {"judged_against_map", !options.map.empty()},
            {"in_obstacle", total.in_obstacle},
            {"through_geometry", total.through_geometry},
            {"jumps", total.jumps},
            {"violations", violations}};
}

std::vector<std::string> violations_of(const Findings& total, const Options& options, double seconds,
                                       const Probes& probes) {
    std::vector<std::string> list = unserved(probes);
    const auto above = [&](std::uint64_t value, std::uint64_t most, const std::string& what) {
        if (value > most) list.push_back(std::to_string(value) + " " + what);
    };
    above(total.gaps, options.max_gaps, "frames are missing");
    above(total.disorder, 0, "frames are out of order");
    above(total.early, 0, "frames left before they were due");
    above(total.invalid, 0, "samples are malformed");
    above(total.in_obstacle, options.max_violations, "cameras are in an obstacle");
    above(total.through_geometry, options.max_violations, "undeclared steps go through geometry");
    above(total.jumps, options.max_violations, "undeclared steps are longer than the limit");
    if (options.max_p99_ms > 0.0 && milliseconds(total.latency.percentile(0.99)) > options.max_p99_ms) {
        list.push_back("the latency's p99 is above " + std::to_string(options.max_p99_ms) + " ms");
    }
    const double rate = static_cast<double>(total.frames) / static_cast<double>(probes.size()) / seconds;
    if (rate < options.min_rate) list.push_back("only " + std::to_string(rate) + " frames a second");
    return list;
}

void wait_until_served(const Probes& probes, double grace, const std::stop_token& stop) {
    const auto start = Clock::now();
    while (!unserved(probes).empty() && since(start) < grace && !stop.stop_requested()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

int probe(const Options& options, const std::stop_token& stop) {
    std::unique_ptr<oracle::Oracle> oracle;
    if (!options.map.empty()) {
        const auto scene = scene::load(options.map);
        if (!scene) {
            std::cerr << "observer-probe: " << scene.error().message << '\n';
            return 1;
        }
        if (!scene->points.empty()) {
            std::cerr << "observer-probe: " << options.map
                      << ": cameras cannot be checked against point clouds\n";
            return 1;
        }
        oracle = std::make_unique<oracle::Oracle>(*scene);
    }
    const camera_director::Context context =
        camera_director::Context::open(options.network.context_options()).value();
    Probes probes;
    for (std::uint32_t match = 0; match < options.matches; ++match) {
        for (std::uint32_t number = 0; number < options.observers; ++number) {
            probes.push_back(std::make_unique<Probe>(context, options, oracle.get(), match, number));
        }
    }
    // Measuring begins when all observers are served.
    wait_until_served(probes, options.grace + options.limits.delay, stop);
    if (unserved(probes).empty()) {
        for (const auto& one : probes)
            one->restart();
    }

    const char* heading = options.by_player ? "player" : "match";
    const bool live = ::isatty(STDERR_FILENO) == 1;
    const auto pause = live ? std::chrono::milliseconds(500) : std::chrono::milliseconds(5000);
    FindingsTable table(std::cerr, heading, live);
    const auto start = Clock::now();
    auto next_table = start + pause;
    while (!stop.stop_requested() && (options.seconds == 0.0 || since(start) < options.seconds)) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        if (Clock::now() < next_table) continue;
        table.print(rows_of(probes, options), since(start));
        next_table += pause;
    }

    const double seconds = since(start);
    const Findings total = sum(probes, 0, probes.size());
    const auto violations = violations_of(total, options, seconds, probes);
    FindingsTable(std::cout, heading, false).print(rows_of(probes, options), seconds);
    for (const std::string& violation : violations)
        std::cout << "VIOLATION: " << violation << '\n';
    if (!options.json.empty()) {
        const auto text = to_json(total, options, start, seconds, violations).dump(2) + "\n";
        if (const auto written = write_file(options.json, text); !written) {
            std::cerr << "observer-probe: " << written.error().message << '\n';
            return 1;
        }
    }
    return violations.empty() ? 0 : 1;
}

void add_options(CLI::App& app, Options& options) {
    app.add_option("--match-prefix", options.match_prefix, "Observes PREFIX-0, PREFIX-1, ...")
        ->capture_default_str();
    app.add_option("--matches", options.matches)->check(CLI::Range(1, 4096))->capture_default_str();
    app.add_option("--observers", options.observers, "Per match; number i requests player i")
        ->check(CLI::Range(1, 256))
        ->capture_default_str();
    app.add_flag("--automatic", options.automatic, "Let the director choose every target");
    app.add_flag("--by-player", options.by_player, "A row for each observer instead of each match");
    app.add_option("--profile", options.profile, "Camera profile; default: the director's");
    app.add_option("--map", options.map, "The source map: check cameras against its obstacles");
    app.add_option("--seconds", options.seconds, "Duration once all are served; 0: until interrupted")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--delay", options.limits.delay,
                   "The match's delay, s: frames must not leave sooner, and latencies count from then")
        ->check(CLI::Range(0.0, 120.0))
        ->capture_default_str();
    app.add_option("--grace", options.grace,
                   "Seconds, after the delay, within which all observers must be served")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--max-step", options.limits.step,
                   "Longest undeclared step from one pose frame to the next, map units")
        ->capture_default_str();
    app.add_option("--min-clearance", options.limits.clearance,
                   "Cameras nearer than this to an obstacle count as in it, map units")
        ->capture_default_str();
    app.add_option("--max-gaps", options.max_gaps, "Missing frames allowed")->capture_default_str();
    app.add_option("--max-violations", options.max_violations,
                   "Cameras in obstacles, steps through geometry and jumps allowed, each")
        ->capture_default_str();
    app.add_option("--max-p99-ms", options.max_p99_ms, "Latency's limit; 0: only reported")
        ->capture_default_str();
    app.add_option("--min-rate", options.min_rate, "Least frames per second that an observer must get")
        ->capture_default_str();
    app.add_option("--json", options.json, "Writes the summary to this file");
    options.network.add_options(app);
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    using namespace camdir;
    soak::Options options;
    CLI::App app("Observers that check the cameras that they receive; exit code 1 on a violation.",
                 "observer-probe");
    soak::add_options(app, options);
    return soak::run_until_interrupted(
        app, argc, argv, [&](const std::stop_token& stop) { return soak::probe(options, stop); });
}
