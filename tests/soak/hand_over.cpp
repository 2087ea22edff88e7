// hand-over: what an observer sees when a director or the game server dies, stops, hangs, is cut off or comes
// back.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iomanip>
#include <iostream>

#include "evaluation/resample.hpp"
#include "hand_over_rows.hpp"
#include "hand_over_stage.hpp"
#include "support/program.hpp"

namespace camdir::soak {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds afterwards{4000};  // at least so long is measured

struct Options {
    Stage::Options stage;
    double seconds = 10.0;
    int runs = 1;
    std::vector<std::string> only;
    double longest_gap_ms = 250.0;  // the lease, and what a take-over needs
    std::uint64_t most_lost = 0;    // with a delay
    bool logs = false;
};

// The hosts of the rows that need some, or why there are none.
struct Network {
    std::optional<Hosts> hosts;
    std::string lacks;
};

void make_hosts(Network& network) {
    network.lacks = enter_own_network();
    if (!network.lacks.empty()) return;
    try {
        network.hosts.emplace(Stage::host_count);
    } catch (const std::runtime_error& error) {
        network.lacks = error.what();
    }
}

// Empty when this machine can make the row.
std::string lacks(const Row& row, const Network& network) {
    if (row.means == Row::Means::hosts) return network.lacks;
    if (row.means == Row::Means::clocks && !StepClock::available()) return "the package libfaketime";
    return "";
}

HandOver play(const Row& row, const Options& options, const evaluation::Trace& trace, Network& network) {
    Stage stage(options.stage, trace, row.means == Row::Means::hosts ? &*network.hosts : nullptr,
                row.means == Row::Means::clocks);
    if (row.from_start) {
        stage.start_game();
        stage.start_observer();
        stage.begin();
        stage.start_leader();
        stage.start_standby();
    } else {
        stage.start_leader();
        stage.start_game();
        stage.start_observer();
        stage.await_leader();
        stage.start_standby();
        // Both know all there is to know.
        std::this_thread::sleep_for(std::chrono::duration<double>(2.5 + options.stage.delay_s));
        stage.begin();
    }
    const auto planned = std::chrono::steady_clock::now() + std::chrono::duration<double>(options.seconds);
    row.happens(stage);
    std::this_thread::sleep_for(afterwards);
    std::this_thread::sleep_until(planned);
    const HandOver found = stage.finish();
    if (options.logs)
        std::cerr << "-- leader\n" << stage.leader->log() << "-- standby\n" << stage.standby->log();
    return found;
}

// What no viewer should see; empty when there was none of it.
std::string fault(const HandOver& found, const Row& row, const Options& options) {
    constexpr double longest_silence_s = 1.0;
    constexpr double gap_filled_by_s = 1.0;  // of delay
    // Cameras turn round a player faster than the player moves, also while a busy machine shows nothing.
    const double farthest_leap = std::max(40.0, 0.1 * found.gap_ms);
    if (found.silent_s > longest_silence_s) return "no cameras any more";
    if (found.stale > 0) return "stale frames";
    if (found.changes > row.changes) return "the match taken from a leader that serves it";
    if (found.unforced > row.forced) return "a cut without a reason";
    if (found.leap > farthest_leap) return "a jump";
    if (row.planned && found.lost > 1) return "lost frames";
    if (options.stage.delay_s >= gap_filled_by_s && row.more_gap_ms == 0.0 && found.lost > options.most_lost)
        return "lost frames";
    const double more_gap_ms = row.more_gap_ms + (row.fills_delay ? 1e3 * options.stage.delay_s : 0.0);
    if (found.gap_ms > options.longest_gap_ms + more_gap_ms) return "a long gap";
    return "";
}

bool is_wanted(const Row& row, const Options& options) {
    return options.only.empty() || std::ranges::any_of(options.only, [&](const std::string& part) {
               return row.name.find(part) != std::string::npos;
           });
}

void print_head() {
    std::cout << std::left << std::setw(32) << "done" << std::right << std::setw(8) << "gap ms"
              << std::setw(6) << "lost" << std::setw(6) << "stale" << std::setw(9) << "changes"
              << std::setw(9) << "unforced" << std::setw(8) << "leap" << std::setw(9) << "no shot"
              << "  fault" << std::endl;
}

void print(const Row& row, const HandOver& found, const std::string& fault) {
    std::cout << std::left << std::setw(32) << row.name << std::right << std::fixed << std::setprecision(0)
              << std::setw(8) << found.gap_ms << std::setw(6) << found.lost << std::setw(6) << found.stale
              << std::setw(9) << found.changes << std::setw(9) << found.unforced << std::setprecision(1)
              << std::setw(8) << found.leap << std::setw(9) << found.unanswered << "  " << fault << std::endl;
}

int run(const Options& options) {
    Network network;
    make_hosts(network);
    auto read = evaluation::read_trace(options.stage.trace);
    if (read) read = evaluation::resample(*read, Stage::rate_hz);
    if (!read) {
        std::cerr << "hand-over: " << read.error().message << '\n';
        return 1;
    }
    print_head();
    int played = 0;
    bool flawless = true;
    for (const Row& row : rows()) {
        if (!is_wanted(row, options)) continue;
        if (const std::string lacking = lacks(row, network); !lacking.empty()) {
            std::cout << std::left << std::setw(32) << row.name << "  needs " << lacking << std::endl;
            continue;
        }
        for (int i = 0; i < options.runs; ++i, ++played) {
            const HandOver found = play(row, options, *read, network);
            const std::string shown = fault(found, row, options);
            print(row, found, shown);
            flawless = flawless && shown.empty();
        }
    }
    if (!flawless) return 1;
    return played > 0 ? 0 : 77;
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    using namespace camdir;
    soak::Options options;
    CLI::App app("What an observer sees when directors and game servers die, stop, hang or come back.",
                 "hand-over");
    app.add_option("map", options.stage.map, "MAP.vfs")->required();
    app.add_option("source", options.stage.source, "The map that it was baked from")->required();
    app.add_option("trace", options.stage.trace, "Recorded match that is replayed, CSV or .mvd, perhaps .gz")
        ->required();
    app.add_option("--bin", options.stage.programs, "Folder of the programs")->capture_default_str();
    app.add_option("--delay", options.stage.delay_s, "Spectator delay, s")->capture_default_str();
    app.add_option("--seconds", options.seconds, "Measured in each row")->capture_default_str();
    app.add_option("--runs", options.runs, "Of each row")->capture_default_str();
    app.add_option("--only", options.only, "Rows whose name contains this; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--max-gap", options.longest_gap_ms, "A longer gap is a fault, ms")->capture_default_str();
    app.add_option("--max-lost", options.most_lost, "With a delay of 1 s: more lost frames are a fault")
        ->capture_default_str();
    app.add_flag("--logs", options.logs, "Shows the directors' logs");
    return test::run_program(app, argc, argv, [&] { return soak::run(options); });
}
