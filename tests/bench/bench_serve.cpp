// bench-serve: what serving costs, beside the least that DDS allows on this machine, and the largest load
// that holds.
#include <iomanip>
#include <iostream>
#include <vector>

#include "program.hpp"
#include "serve/served_load.hpp"

namespace camdir::bench {
namespace {

constexpr double rate_hz = 60.0;
constexpr Load loads[] = {{1, 1, rate_hz},  {1, 8, rate_hz},  {40, 1, rate_hz},
                          {40, 4, rate_hz}, {4, 32, rate_hz}, {16, 32, rate_hz}};
constexpr std::size_t one_shot = 2;  // the loads whose difference is cameras alone
constexpr std::size_t four_shots = 3;
constexpr std::uint32_t shots_of_largest = 8;
constexpr std::uint32_t most_matches = 1024;

void print_heading() {
    std::cout << "Cameras: p50 and p99 from a pose's sending to its camera's arrival, ms, and the ratio of "
                 "the p50; "
                 "processor time of the server.\n\n"
                 "| matches x shots | frames/s | p50 | p99 | raw p50 | raw p99 | ratio | cores | raw cores "
                 "| us a match frame | raw | waits a match frame | raw | cameras/s a core |\n"
                 "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
}

void print(const Load& load, const Served& served, const Served& raw) {
    std::cout << std::fixed << std::setprecision(2) << "| " << load.matches << " x " << load.shots << " | "
              << served.frames_per_s << " | " << served.p50_ms << " | " << served.p99_ms << " | "
              << raw.p50_ms << " | " << raw.p99_ms << " | " << served.p50_ms / raw.p50_ms << " | "
              << served.cores << " | " << raw.cores << std::setprecision(0) << " | "
              << served.microseconds_a_frame(load) << " | " << raw.microseconds_a_frame(load) << " | "
              << std::setprecision(2) << served.waits_a_frame(load) << " | " << raw.waits_a_frame(load)
              << " | " << std::setprecision(0) << served.cameras_a_core(load) << " |" << std::endl;
}

// The most matches of 8 shots that the server holds, to an eighth: doubled until it does not, then narrowed.
std::uint32_t largest_load(const Bench& bench, Server server) {
    const auto holds = [&](std::uint32_t matches) {
        const Load load{matches, shots_of_largest, rate_hz};
        const bool held = serve(bench, server, load).holds(load);
        std::cerr << matches << " matches: " << (held ? "held" : "not held") << '\n';
        return held;
    };
    std::uint32_t most = 0;
    std::uint32_t few = 8;
    while (few <= most_matches && holds(few)) {
        most = few;
        few *= 2;
    }
    if (most == 0 || few > most_matches) return most;
    for (std::uint32_t step = most / 2; step > most / 16; step /= 2)
        if (holds(most + step)) most += step;
    return most;
}

int run(const Bench& bench, bool largest) {
    print_heading();
    std::vector<double> us;
    for (const Load& load : loads) {
        const Served served = serve(bench, Server::director, load);
        print(load, served, serve(bench, Server::raw, load));
        us.push_back(served.microseconds_a_frame(load));
    }
    const double camera = (us[four_shots] - us[one_shot]) / 3.0;
    std::cout << "\nOf 40 matches: " << camera << " us a camera, " << us[one_shot] - camera
              << " us a match frame beside its cameras\n";
    if (!largest) return 0;
    std::cout << "\nMatches of " << shots_of_largest
              << " shots and observers that hold: " << largest_load(bench, Server::director) << "; raw "
              << largest_load(bench, Server::raw) << '\n';
    return 0;
}

}  // namespace
}  // namespace camdir::bench

int main(int argc, char** argv) {
    using namespace camdir::bench;
    CLI::App app("What serving costs, beside the least that DDS allows on this machine, in one run.",
                 "bench-serve");
    Bench bench{.programs = CAMDIR_BIN_DIR, .map_file = {}, .source = {}, .seconds = 5.0};
    bool largest = false;
    app.add_option("map", bench.map_file, "Baked map, MAP.vfs")->required()->check(CLI::ExistingFile);
    app.add_option("--source", bench.source, "What it was baked from: a file or ARCHIVE.pk3:MEMBER")
        ->required();
    app.add_option("--seconds", bench.seconds, "Measured of each load")
        ->check(CLI::Range(1.0, 3600.0))
        ->capture_default_str();
    app.add_flag("--largest", largest, "Also look for the largest load that holds");
    return run_program(app, argc, argv, [&] { return run(bench, largest); });
}
