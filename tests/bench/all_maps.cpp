// bench-all-maps: bakes and verifies many maps, and prints the table of their figures.
//
// Exit codes: 0 every hard limit holds; 1 one does not, or a map could not be baked; 2 bad usage. The limits:
// no unsafe ball, no reported distance beyond the clearance, 99.9 % coverage at clearance > d0, every spawn
// point covered and all of them in one component of the roadmap, the same bytes for any number of threads
// (with --check-threads).
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "bench/program.hpp"
#include "map_sources.hpp"
#include "measured_map.hpp"
#include "measured_table.hpp"

namespace camdir::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
    std::vector<std::string> sources;
    std::string openarena = "/usr/share/games/openarena/baseoa/pak1-maps.pk3";
    std::string only;
    std::string bake_options;
    MeasureParameters parameters;
};

std::vector<MapSource> maps_to_measure(const Options& options) {
    std::vector<std::string> sources = options.sources;
    if (!options.openarena.empty()) sources.insert(sources.begin(), options.openarena);
    std::vector<MapSource> maps;
    for (const std::string& source : sources)
        for (MapSource& map : maps_of(source))
            if (map.name.find(options.only) != std::string::npos) maps.push_back(std::move(map));
    return maps;
}

int run(Options& options) {
    options.parameters.bake_options = CLI::detail::split_up(options.bake_options);
    fs::create_directories(options.parameters.work);
    const std::vector<MapSource> maps = maps_to_measure(options);
    std::vector<MeasuredMap> measured;
    std::cout << head_of_table() << std::flush;
    for (const MapSource& map : maps) {
        std::cerr << measured.size() + 1 << " of " << maps.size() << ": " << map.name << std::flush;
        measured.push_back(measure(map, options.parameters));
        std::cerr << (measured.back().failures.empty() ? "" : ": " + measured.back().failures.front())
                  << '\n';
        std::cout << row_of(measured.back()) << std::flush;
    }
    std::cout << end_of_table(measured);
    for (const MeasuredMap& map : measured)
        if (!map.failures.empty()) return 1;
    return measured.empty() ? 1 : 0;
}

void add_options(CLI::App& app, Options& options) {
    app.add_option("SOURCE", options.sources, "More maps: folders, archives, files");
    app.add_option("--openarena", options.openarena, "OpenArena's archive of maps; empty: without them")
        ->capture_default_str();
    app.add_option("--only", options.only, "Only maps whose name contains this");
    app.add_option("--balls", options.parameters.balls, "Balls to draw on each map")->capture_default_str();
    app.add_option("--points", options.parameters.points, "Free points to draw on each map")
        ->capture_default_str();
    app.add_option("--bake-options", options.bake_options, "More options for the bake, such as \"--loss 3\"");
    app.add_flag("--check-threads", options.parameters.check_threads,
                 "Also bake with 1 and with 2 threads, unless that is the default, and compare the bytes");
    app.add_option("--work", options.parameters.work, "Folder where the baked maps stay")
        ->capture_default_str();
}

int run(int argc, char** argv) {
    Options options;
    options.parameters.programs = fs::read_symlink("/proc/self/exe").parent_path();
    options.parameters.work = fs::temp_directory_path() / "camera-director-all-maps";
    options.parameters.balls = 10'000'000;
    CLI::App app("Bakes and verifies every map of openarena-081-maps and prints the table of their figures.",
                 "bench-all-maps");
    add_options(app, options);
    return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace camdir::bench

int main(int argc, char** argv) {
    return camdir::bench::run(argc, argv);
}
