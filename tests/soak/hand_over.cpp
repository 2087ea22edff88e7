// hand-over: what an observer sees when a director or the game server dies, stops, hangs, is cut off or comes
// back.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <csignal>
#include <functional>
#include <iomanip>
#include <iostream>
#include <iterator>

#include "evaluation/resample.hpp"
#include "hand_over_stage.hpp"

namespace camdir::soak {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds absence{6000};
// DDS forgets who is silent for 10 s.
constexpr milliseconds long_absence{12'000}, forgotten_absence{15'000};
constexpr milliseconds afterwards{4000};  // at least so long is measured

struct Options {
    Stage::Options stage;
    double seconds = 10.0;
    int runs = 1;
    std::string only;
    double longest_gap_ms = 450.0;  // the lease and as much again, for a busy machine
    bool logs = false;
};

struct Row {
    std::string name;
    std::function<void(Stage&)> happens;
    bool from_start = false;   // measures from the first frame
    double more_gap_ms = 0.0;  // where it is not the directors' fault
    std::uint64_t forced = 0;  // cuts where the game's own poses jump
    enum class Means { processes, hosts, clocks } means = Means::processes;
};

const std::vector<Stage::Way> leader_cut_off{{Stage::leaders, Stage::standbys},
                                             {Stage::standbys, Stage::leaders},
                                             {Stage::leaders, Stage::clients},
                                             {Stage::clients, Stage::leaders}};
const std::vector<Stage::Way> standby_cut_off{{Stage::leaders, Stage::standbys},
                                              {Stage::standbys, Stage::leaders},
                                              {Stage::standbys, Stage::clients},
                                              {Stage::clients, Stage::standbys}};
const std::vector<Stage::Way> directors_apart{{Stage::leaders, Stage::standbys},
                                              {Stage::standbys, Stage::leaders}};
const std::vector<Stage::Way> leader_deaf{{Stage::standbys, Stage::leaders},
                                          {Stage::clients, Stage::leaders}};
const std::vector<Stage::Way> leader_dumb{{Stage::leaders, Stage::standbys},
                                          {Stage::leaders, Stage::clients}};

// What the network does between hosts.
std::vector<Row> network_rows() {
    const auto row = [](const std::string& name, const std::vector<Stage::Way>& ways, milliseconds duration) {
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(duration).count();
        return Row{.name = name + " " + std::to_string(seconds) + " s",
                   .happens = [&ways, duration](Stage& s) { s.cut(ways, duration); },
                   .means = Row::Means::hosts};
    };
    return {
        {.name = "nothing, three hosts", .happens = [](Stage&) {}, .means = Row::Means::hosts},
        row("leader cut off", leader_cut_off, absence),
        row("leader cut off", leader_cut_off, forgotten_absence),
        row("leader deaf", leader_deaf, absence),
        row("leader deaf", leader_deaf, forgotten_absence),
        row("leader dumb", leader_dumb, absence),
        row("leader dumb", leader_dumb, forgotten_absence),
        row("standby cut off", standby_cut_off, absence),
        row("standby cut off", standby_cut_off, forgotten_absence),
        row("directors apart", directors_apart, absence),
        row("directors apart", directors_apart, forgotten_absence),
    };
}

std::vector<Row> clock_rows() {
    const auto row = [](const std::string& name, auto clock, std::chrono::seconds by) {
        return Row{.name = name + (by.count() < 0 ? " an hour back" : " an hour on"),
                   .happens = [=](Stage& s) { (s.*clock)->step(by); },
                   .means = Row::Means::clocks};
    };
    constexpr std::chrono::hours hour{1};
    return {row("leader's clock", &Stage::leader_clock, hour),
            row("leader's clock", &Stage::leader_clock, -hour), row("game's clock", &Stage::game_clock, hour),
            row("game's clock", &Stage::game_clock, -hour)};
}

std::vector<Row> process_rows() {
    const auto pause = [] { std::this_thread::sleep_for(absence); };
    return {
        {"nothing", [](Stage&) {}},
        {"leader killed", [](Stage& s) { s.leader->signal(SIGKILL); }},
        {"leader SIGTERM", [](Stage& s) { s.leader->signal(SIGTERM); }},
        {"leader hands over", [](Stage& s) { s.leader->hand_over(); }},
        {"leader stopped 6 s",
         [=](Stage& s) {
             s.leader->signal(SIGSTOP);
             pause();
             s.leader->signal(SIGCONT);
         }},
        {"leader stopped 12 s",
         [](Stage& s) {
             s.leader->signal(SIGSTOP);
             std::this_thread::sleep_for(long_absence);
             s.leader->signal(SIGCONT);
         }},
        {"leader killed, back",
         [=](Stage& s) {
             s.leader->signal(SIGKILL);
             s.leader->wait();
             pause();
             s.start_leader();
         }},
        {"both start together", [](Stage&) {}, true},
        {"leader back, baking",
         [=](Stage& s) {
             s.leader->signal(SIGKILL);
             s.leader->wait();
             std::this_thread::sleep_for(milliseconds(1000));
             s.return_while_the_map_is_baked();
         }},
        {"standby stopped 6 s",
         [=](Stage& s) {
             s.standby->signal(SIGSTOP);
             pause();
             s.standby->signal(SIGCONT);
         }},
        {"standby killed", [](Stage& s) { s.standby->signal(SIGKILL); }},
        {"leader's workers hang 6 s", [](Stage& s) { s.leader->hang_threads("worker-", absence); }},
        {"leader's reception hangs 6 s", [](Stage& s) { s.leader->hang_threads("reception", absence); }},
        {"observer late 1 s", [](Stage& s) { s.pause_observer(milliseconds(1000)); }, false, 1000.0},
        {"game stopped 6 s",
         [=](Stage& s) {
             s.game->send_signal(SIGSTOP);
             pause();
             s.game->send_signal(SIGCONT);
         },
         false, 6000.0, 1},
        {"game restarted",
         [](Stage& s) {
             s.game->send_signal(SIGKILL);
             s.game->wait();
             s.start_game();
         },
         false, 1000.0},
    };
}

std::vector<Row> rows() {
    std::vector<Row> all;
    for (std::vector<Row>& some : std::array{process_rows(), network_rows(), clock_rows()})
        std::ranges::move(some, std::back_inserter(all));
    return all;
}

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
    constexpr double farthest_leap = 40.0;  // cameras turn round a player faster than the player moves
    if (found.silent_s > longest_silence_s) return "no cameras any more";
    if (found.stale > 0) return "stale frames";
    if (found.unforced > row.forced) return "a cut without a reason";
    if (found.leap > farthest_leap) return "a jump";
    if (found.gap_ms > options.longest_gap_ms + row.more_gap_ms) return "a long gap";
    return "";
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
        if (row.name.find(options.only) == std::string::npos) continue;
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
    app.add_option("trace", options.stage.trace, "Recorded match that is replayed, CSV or CSV.gz")
        ->required();
    app.add_option("--bin", options.stage.programs, "Folder of the programs")->capture_default_str();
    app.add_option("--delay", options.stage.delay_s, "Spectator delay, s")->capture_default_str();
    app.add_option("--seconds", options.seconds, "Measured in each row")->capture_default_str();
    app.add_option("--runs", options.runs, "Of each row")->capture_default_str();
    app.add_option("--only", options.only, "Rows whose name contains this");
    app.add_option("--max-gap", options.longest_gap_ms, "A longer gap is a fault, ms")->capture_default_str();
    app.add_flag("--logs", options.logs, "Shows the directors' logs");
    CLI11_PARSE(app, argc, argv);
    try {
        return soak::run(options);
    } catch (const std::exception& error) {
        std::cerr << "hand-over: " << error.what() << '\n';
        return 1;
    }
}
