// bench-paper: the paper as a baseline. Bakes one map by the paper's method and by each change of the project
// added to it, judges all by the exact judge of `verify`, and prints the paper's figure 6 with one column a
// method. Every method runs in a process of its own.
//
// Exit codes: 0 done, 1 a method failed, 2 bad usage.
#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <stdexcept>

#include "bench/paper/judgement.hpp"
#include "bench/paper/sampling.hpp"
#include "bench/paper/table.hpp"
#include "scene/load.hpp"
#include "support/child_process.hpp"

namespace camdir::paper {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* engines_part = "engines";
constexpr const char* d0_part = "d0";

struct Options {
    std::string map;
    Settings settings;
    std::uint64_t samples = 0;
    std::uint64_t balls = 100'000;
    int runs = 3;
    std::vector<std::string> only;
    std::string part;
    bool json = false;
};

// The d0 at which the paper's rule takes about this many samples.
Result<double> find_d0(const scene::Scene& scene, std::uint64_t wanted) {
    const double unit = 0.0254 / scene.metres_per_unit;
    double low = bake::min_d0;
    double high = bake::max_d0;
    for (int i = 0; i < 16; ++i) {
        const double middle = std::sqrt(low * high);
        const auto samples = sample(scene, middle * unit);
        // Too many for memory is too many, too.
        const bool too_many = !samples || samples->size() > wanted;
        (too_many ? low : high) = middle;
    }
    return high;
}

// What a child process does.
Result<Json> measure_part(const Options& options) {
    const auto scene = scene::load(options.map);
    if (!scene) return tl::unexpected(scene.error());
    if (options.part == d0_part)
        return find_d0(*scene, options.samples).map([](double d0) { return Json(d0); });
    if (options.part == engines_part) {
        const auto engines = compare_engines(*scene, options.settings.d0, options.runs);
        if (!engines) return tl::unexpected(engines.error());
        return to_json(*engines);
    }
    for (const Method& method : methods())
        if (method.key == options.part) return measure(method, *scene, options.settings, options.balls);
    return fail("no part " + options.part);
}

std::string own_path() {
    return std::filesystem::read_symlink("/proc/self/exe").string();
}

std::string exact(double value) {
    std::ostringstream text;
    text << std::setprecision(17) << value;
    return text.str();
}

// Runs a part in a child process. Throws std::runtime_error with what the child said when it fails.
Json run_part(const std::string& part, const Options& options) {
    std::cerr << "bench-paper: " << part << std::flush;
    Stopwatch stopwatch;
    std::vector<std::string> command{own_path(), options.map, "--part", part};
    const auto pass = [&](const char* option, std::string value) {
        command.insert(command.end(), {option, std::move(value)});
    };
    if (part == d0_part)
        pass("--samples", std::to_string(options.samples));
    else
        pass("--d0", exact(options.settings.d0));
    pass("--threads", std::to_string(options.settings.threads));
    pass("--swap-threshold", exact(options.settings.swap_threshold));
    pass("--loss", exact(options.settings.loss));
    pass("--balls", std::to_string(options.balls));
    pass("--runs", std::to_string(options.runs));
    test::ChildProcess child(command);
    if (child.wait() != 0) throw std::runtime_error(part + ": " + child.errors());
    std::cerr << ": " << std::lround(stopwatch.lap().seconds) << " s\n";
    return Json::parse(child.output());
}

// None when the program is not there.
std::optional<double> yardstick_seconds() {
    const auto program = std::filesystem::path(own_path()).parent_path() / "bench-delaunay";
    if (!std::filesystem::exists(program)) return std::nullopt;
    test::ChildProcess child({program.string()});
    if (child.wait() != 0) throw std::runtime_error("bench-delaunay: " + child.errors());
    return std::stod(child.output());
}

bool wanted(const Options& options, std::string_view part) {
    return options.only.empty() ||
           std::find(options.only.begin(), options.only.end(), part) != options.only.end();
}

Json head_of(const Options& options) {
    return {{"map", options.map},
            {"d0", options.settings.d0},
            {"threads", options.settings.threads},
            {"swap_threshold", options.settings.swap_threshold},
            {"loss", options.settings.loss},
            {"methods", Json::array()}};
}

// The column by itself, so that whoever stops a long run has what was measured.
void show_column(const Options& options, const Json& method) {
    Json alone = head_of(options);
    alone["methods"].push_back(method);
    std::cerr << table_of(alone) << std::flush;
}

Json run_all(Options options) {
    if (options.samples > 0) options.settings.d0 = run_part(d0_part, options).get<double>();
    Json report = head_of(options);
    for (const Method& method : methods()) {
        if (!wanted(options, method.key)) continue;
        report["methods"].push_back(run_part(std::string(method.key), options));
        show_column(options, report["methods"].back());
    }
    if (wanted(options, engines_part)) {
        report["engines"] = run_part(engines_part, options);
        report["engines"]["runs"] = options.runs;
        if (const auto seconds = yardstick_seconds()) report["engines"]["yardstick_seconds"] = *seconds;
    }
    return report;
}

int run_program(const Options& options) {
    if (!options.part.empty()) {
        const auto json = measure_part(options);
        if (!json) {
            std::cerr << json.error().message << '\n';
            return 1;
        }
        std::cout << *json << '\n';
        return 0;
    }
    const Json report = run_all(options);
    std::cout << (options.json ? report.dump(2) + "\n" : table_of(report));
    return 0;
}

void add_options(CLI::App& app, Options& options) {
    std::vector<std::string> parts{engines_part};
    for (const Method& method : methods())
        parts.emplace_back(method.key);
    app.add_option("MAP", options.map, "Map file, or archive.pk3:maps/name.bsp")->required();
    auto* d0 = app.add_option("--d0", options.settings.d0, "Sampling distance in units of 0.0254 m")
                   ->check(CLI::Range(bake::min_d0, bake::max_d0))
                   ->capture_default_str();
    app.add_option("--samples", options.samples,
                   "Choose d0 such that the paper's rule takes about this many samples")
        ->excludes(d0);
    app.add_option("--balls", options.balls, "Balls to draw; every vertex and edge midpoint comes on top")
        ->capture_default_str();
    app.add_option("--threads", options.settings.threads, "Threads of every method")
        ->check(CLI::Range(1U, 1024U))
        ->capture_default_str();
    app.add_option("--swap-threshold", options.settings.swap_threshold,
                   "Eliminate vertices by swaps as long as that loses less freespace than this many d0^3")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("--loss", options.settings.loss, "Half-edge collapse: the baker's --loss")
        ->check(CLI::Range(0.0, bake::max_loss))
        ->capture_default_str();
    app.add_option("--runs", options.runs, "Of the comparison of the Voronoi engines")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    app.add_option("--only", options.only, "Only these columns, or the comparison of the engines")
        ->check(CLI::IsMember(parts))
        ->delimiter(',');
    parts.emplace_back(d0_part);
    app.add_option("--part", options.part, "Do one part in this process and print its JSON")
        ->check(CLI::IsMember(parts))
        ->group("");
    app.add_flag("--json,!--markdown", options.json, "Print JSON; the default is a table in Markdown");
}

}  // namespace
}  // namespace camdir::paper

int main(int argc, char** argv) {
    camdir::paper::Options options;
    CLI::App app("Bakes a map by the paper's method and by each change of the project, in one table.",
                 "bench-paper");
    camdir::paper::add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        return camdir::paper::run_program(options);
    } catch (const std::exception& error) {
        std::cerr << "\nbench-paper: " << error.what() << '\n';
        return 1;
    }
}
