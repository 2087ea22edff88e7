// chaos: carries a scenario out on directors and judges what the observers of real matches see meanwhile.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <mutex>
#include <thread>

#include "base/file.hpp"
#include "chaos_page.hpp"
#include "chaos_stage.hpp"
#include "program.hpp"
#include "scenario.hpp"
#include "usage.hpp"
#include "verdict.hpp"

namespace camdir::soak {
namespace {

constexpr double slice_s = 0.5;
constexpr int exit_not_judged = 77;
constexpr double least_judged_share = 0.25;

struct Options {
    std::string scenario, map, report;
    std::string programs = CAMDIR_BIN_DIR;
    double seconds = 0.0, hours = 0.0;
    bool logs = false, sanitized = false;
};

// Carries out the acts of a scenario, each in a thread of its own, from its construction on.
class Acts {
  public:
    Acts(ChaosStage& stage, const Scenario& scenario, std::function<double()> now)
        : stage_(stage), end_(scenario.seconds - scenario.settle_s), now_(std::move(now)) {
        for (const Act& act : scenario.acts) {
            ++running_;
            threads_.emplace_back([this, act](const std::stop_token& stop) {
                repeat(act, stop);
                --running_;
            });
        }
    }

    [[nodiscard]] bool are_running() const { return running_ > 0; }
    // By their begin. Stops those that are running.
    [[nodiscard]] std::vector<ActRecord> finish() {
        threads_.clear();
        std::ranges::sort(records_, {}, &ActRecord::begin);
        return std::move(records_);
    }

  private:
    void repeat(const Act& act, const std::stop_token& stop) {
        for (double due = act.at_s; due + act.for_s <= end_ && !stop.stop_requested();) {
            sleep_for(std::max(0.0, due - now_()), stop);
            if (stop.stop_requested()) return;
            ActRecord record = stage_.perform(act, now_, stop);
            const std::lock_guard lock(mutex_);
            records_.push_back(std::move(record));
            if (act.every_s == 0.0) return;
            due = std::max(due + act.every_s, now_());
        }
    }

    ChaosStage& stage_;
    const double end_;
    const std::function<double()> now_;
    std::mutex mutex_;  // guards the records
    std::vector<ActRecord> records_;
    std::atomic<int> running_{0};
    std::vector<std::jthread> threads_;
};

Timeline play(ChaosStage& stage, const Scenario& scenario, const std::stop_token& stop) {
    Timeline timeline{scenario, {}, {}};
    Metronome metronome;
    sleep_for(scenario.settle_s / 2.0 + scenario.delay_s, stop);  // what begins is not measured
    (void)stage.witness().take();
    (void)metronome.take_stall();
    const auto begun = std::chrono::steady_clock::now();
    const auto now = [begun] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    };
    Acts acts(stage, scenario, now);
    double end = scenario.seconds;
    double last = 0.0;
    while (last < end && !stop.stop_requested()) {
        sleep_for(slice_s, stop);
        timeline.slices.push_back(
            {last, now(), stage.witness().take(), metronome.take_stall(), stage.usages()});
        last = timeline.slices.back().end;
        if (acts.are_running()) end = std::max(end, last + scenario.settle_s);
    }
    timeline.acts = acts.finish();
    return timeline;
}

void print(const Timeline& timeline) {
    std::cout << std::left << std::setw(18) << "act" << std::right << std::setw(9) << "from s" << std::setw(9)
              << "to s" << std::setw(9) << "gap ms" << std::setw(7) << "lost" << std::setw(8) << "back s"
              << std::setw(10) << "answered" << '\n';
    for (const ActRecord& act : timeline.acts) {
        const ActFindings found = findings_of(act, timeline);
        std::cout << std::left << std::setw(18) << name_of(act.act.kind) << std::right << std::fixed
                  << std::setprecision(1) << std::setw(9) << act.begin << std::setw(9) << act.end
                  << std::setprecision(0) << std::setw(9) << 1e3 * found.gap_s << std::setw(7) << found.lost
                  << std::setprecision(1) << std::setw(8) << found.back_s << std::setw(10) << act.invented
                  << '\n';
    }
}

void print(const std::vector<Check>& checks) {
    for (const Check& check : checks)
        std::cout << std::left << std::setw(12) << name_of(check.verdict) << check.what << ": " << check.seen
                  << ", allowed: " << check.allowed << '\n';
}

int run(const Options& options, const std::stop_token& stop) {
    auto scenario = read_scenario(options.scenario);
    if (!scenario) {
        std::cerr << "chaos: " << scenario.error().message << '\n';
        return 2;
    }
    if (options.seconds > 0.0) scenario->seconds = options.seconds;
    if (options.hours > 0.0) scenario->seconds = 3600.0 * options.hours;

    ChaosStage stage({options.programs, options.map}, *scenario);
    const Timeline timeline = play(stage, *scenario, stop);
    const std::string problem = stage.end();
    auto checks = judge(timeline, options.sanitized);
    checks.push_back({"directors end as they should", problem.empty() ? "yes" : problem, "yes",
                      problem.empty() ? Verdict::passed : Verdict::failed});
    print(timeline);
    print(checks);
    const double judged = judged_share(timeline);
    std::cout << "frames were judged in " << std::setprecision(0) << 100.0 * judged
              << " % of the time; in the rest the machine stalled or a crowd had it\n";
    if (options.logs) std::cerr << stage.logs();
    if (!options.report.empty()) {
        const auto written = write_file(options.report, to_html(timeline, checks));
        if (!written) throw std::runtime_error(written.error().message);
    }
    if (std::ranges::any_of(checks, is_failed)) return 1;
    return judged < least_judged_share && !options.sanitized ? exit_not_judged : 0;
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    using namespace camdir;
    soak::Options options;
    CLI::App app("Kills, floods and deceives directors, and judges what observers see meanwhile.", "chaos");
    app.add_option("scenario", options.scenario, "What happens, JSON")->required();
    app.add_option("map", options.map, "Baked map, MAP.vfs")->required();
    app.add_option("--bin", options.programs, "Folder of the programs")->capture_default_str();
    auto* seconds = app.add_option("--seconds", options.seconds, "Measured; default: the scenario's")
                        ->check(CLI::Range(1.0, 1e7));
    app.add_option("--hours", options.hours, "The same in hours")
        ->check(CLI::Range(0.001, 1e4))
        ->excludes(seconds);
    app.add_option("--report", options.report, "Writes a page with plots over time, HTML");
    app.add_flag("--sanitized", options.sanitized,
                 "The programs have sanitizers: judges neither memory nor what observers see");
    app.add_flag("--logs", options.logs, "Shows the directors' logs");
    return soak::run_until_interrupted(app, argc, argv,
                                       [&](const std::stop_token& stop) { return soak::run(options, stop); });
}
