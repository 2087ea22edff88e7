// bench-paper: the paper as a baseline. Bakes one map by the paper's method and by each change of the project
// added to it, judges all by the exact judge of `verify`, and prints the paper's figure 6 with one column a
// method. Every method runs in a process of its own: one that fails or takes too long says so in its column,
// and leaves the others alone.
//
// Exit codes: 0 done, 1 something failed, 2 bad usage.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "bench/paper/judgement.hpp"
#include "bench/paper/sampling.hpp"
#include "bench/paper/table.hpp"
#include "scene/load.hpp"
#include "support/child_process.hpp"

namespace camdir::paper {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* engines_column = "engines";
constexpr const char* qhull_part = "engine-qhull";
constexpr const char* cgal_part = "engine-cgal";
constexpr const char* d0_part = "d0";

struct Options {
    std::string map;
    Settings settings;
    std::uint64_t samples = 0;
    std::uint64_t balls = 100'000;
    int runs = 3;
    double limit = 600.0;  // seconds a part
    std::vector<std::string> only;
    std::string part;
    bool json = false;
};

// The d0 at which the paper's rule takes about this many samples.
Result<double> find_d0(const scene::Scene& scene, std::uint64_t target) {
    const double unit = metres_of_nominal_unit / scene.metres_per_unit;
    double low = bake::min_d0;
    double high = bake::max_d0;
    for (int i = 0; i < 16; ++i) {
        const double middle = std::sqrt(low * high);
        const auto samples = sample(scene, middle * unit);
        // Too many for memory is too many, too.
        const bool too_many = !samples || samples->size() > target;
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
    if (options.part == qhull_part || options.part == cgal_part) {
        const Engine engine = options.part == qhull_part ? Engine::qhull : Engine::cgal;
        return measure_engine(engine, *scene, options.settings.d0, options.runs)
            .map([](const EngineCost& cost) { return to_json(cost); });
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

std::vector<std::string> command_of(const std::string& part, const Options& options) {
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
    return command;
}

// The last line of what it printed, or the signal that killed it.
std::string reason_of(const test::ChildProcess& child, int code) {
    if (code < 0) return "killed by signal " + std::to_string(-code);
    std::istringstream errors(child.errors());
    std::string reason = "exit code " + std::to_string(code);
    for (std::string line; std::getline(errors, line);)
        if (!line.empty()) reason = line;
    return reason;
}

// Runs a part in a child process, which is killed after options.limit.
Result<Json> run_part(const std::string& part, const Options& options) {
    std::cerr << "bench-paper: " << part << std::flush;
    Stopwatch stopwatch;
    test::ChildProcess child(command_of(part, options));
    const auto code = child.wait_for(std::chrono::milliseconds(std::llround(1000.0 * options.limit)));
    std::string failure;
    if (!code) {
        std::ostringstream text;
        text << "more than " << options.limit << " s";
        failure = text.str();
    } else if (*code != 0) {
        failure = reason_of(child, *code);
    }
    if (!failure.empty()) {
        std::cerr << ": failed: " << failure << '\n';
        return fail(failure);
    }
    std::cerr << ": " << std::lround(stopwatch.lap().seconds) << " s\n";
    Json json = Json::parse(child.output(), nullptr, false);
    if (json.is_discarded()) return fail("its output is no JSON");
    return json;
}

// None when the program is not there, or fails.
std::optional<double> yardstick_seconds() {
    const auto program = std::filesystem::path(own_path()).parent_path() / "bench-delaunay";
    if (!std::filesystem::exists(program)) return std::nullopt;
    test::ChildProcess child({program.string()});
    if (child.wait() != 0) return std::nullopt;
    return std::stod(child.output());
}

bool is_selected(const Options& options, std::string_view part) {
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

// The column by itself, so that a long run that is stopped leaves what was measured.
void show_column(const Options& options, const Json& method) {
    Json alone = head_of(options);
    alone["methods"].push_back(method);
    std::cerr << table_of(alone) << std::flush;
}

Json run_method(const Method& method, const Options& options) {
    auto measured = run_part(std::string(method.key), options);
    if (!measured)
        return {{"key", method.key}, {"title", method.title}, {"failed", measured.error().message}};
    show_column(options, *measured);
    return std::move(*measured);
}

Json run_engines(const Options& options) {
    Json engines{{"runs", options.runs}};
    for (const auto& [name, part] : {std::pair{"qhull", qhull_part}, std::pair{"cgal", cgal_part}}) {
        auto measured = run_part(part, options);
        engines[name] = measured ? std::move(*measured) : Json{{"failed", measured.error().message}};
    }
    if (const auto seconds = yardstick_seconds()) engines["yardstick_seconds"] = *seconds;
    return engines;
}

Result<Json> run_all(Options options) {
    if (options.samples > 0) {
        const auto d0 = run_part(d0_part, options);
        if (!d0) return tl::unexpected(d0.error());
        options.settings.d0 = d0->get<double>();
    }
    Json report = head_of(options);
    for (const Method& method : methods())
        if (is_selected(options, method.key)) report["methods"].push_back(run_method(method, options));
    if (is_selected(options, engines_column)) report["engines"] = run_engines(options);
    return report;
}

bool has_failure(const Json& report) {
    const auto failed = [](const Json& part) { return part.contains("failed"); };
    if (std::any_of(report["methods"].begin(), report["methods"].end(), failed)) return true;
    return report.contains("engines") &&
           (failed(report["engines"]["qhull"]) || failed(report["engines"]["cgal"]));
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
    const auto report = run_all(options);
    if (!report) return 1;
    std::cout << (options.json ? report->dump(2) + "\n" : table_of(*report));
    return has_failure(*report) ? 1 : 0;
}

void add_options(CLI::App& app, Options& options) {
    std::vector<std::string> columns{engines_column};
    for (const Method& method : methods())
        columns.emplace_back(method.key);
    std::vector<std::string> parts = columns;
    parts.insert(parts.end(), {qhull_part, cgal_part, d0_part});
    app.add_option("MAP", options.map, "Map file, or archive.pk3:maps/name.bsp")->required();
    auto* d0 = app.add_option("--d0", options.settings.d0, "Sampling distance in units of 0.0254 m")
                   ->check(CLI::Range(bake::min_d0, bake::max_d0))
                   ->capture_default_str();
    app.add_option("--samples", options.samples,
                   "Choose d0 such that the paper's rule takes about this many samples")
        ->excludes(d0);
    app.add_option("--balls", options.balls, "Balls to draw, in addition to every vertex and edge midpoint")
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
    app.add_option("--limit", options.limit,
                   "Seconds after which a method, or an engine of that comparison, has failed")
        ->check(CLI::Range(0.001, 1e6))
        ->capture_default_str();
    app.add_option("--only", options.only, "Only these columns, or the comparison of the engines")
        ->check(CLI::IsMember(columns))
        ->delimiter(',');
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
