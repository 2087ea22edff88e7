// camera-director bake: a map file becomes a MAP.vfs.
#include <cmath>
#include <iostream>
#include <set>

#include "app/bake_config.hpp"
#include "app/commands.hpp"
#include "app/progress.hpp"
#include "bake/bake.hpp"
#include "base/file.hpp"
#include "base/signals.hpp"
#include "config/config.hpp"
#include "config/json_text.hpp"
#include "freespace/freespace.hpp"
#include "maps/memory.hpp"
#include "maps/progress.hpp"
#include "maps/report.hpp"
#include "maps/source.hpp"
#include "scene/load.hpp"

namespace camdir::app {
namespace {

struct BakeOptions {
    std::string map;
    std::string output;
    std::string report;
    bake::Parameters parameters;
    scene::ReadOptions read;
    std::uint64_t memory_mib = 0;
    bool quiet = false;
    // For the form with --config.
    std::string config;
    bool force = false;

    [[nodiscard]] std::uint64_t memory() const { return memory_mib * 1024U * 1024U; }
};

void print_source(const scene::Scene& scene, const bake::Parameters& parameters) {
    const double d0 = bake::sampling_distance(scene, parameters);
    std::cerr << scene.source << ": " << scene.kind << ", "
              << (scene.points.empty() ? scene.triangles.size() : scene.points.size())
              << (scene.points.empty() ? " triangles" : " points") << ", " << scene.spawn_points.size()
              << " spawn points, d0 " << d0 * scene.metres_per_unit << " m\n";
}

// Announces a bake that takes more than a minute.
void print_forecast(const bake::Forecast& forecast) {
    if (forecast.seconds <= bake::quick_seconds) return;
    const long minutes = std::lround(forecast.seconds / 60.0);
    std::cerr << "This bake is expected to take about " << minutes << (minutes == 1 ? " minute" : " minutes")
              << " and " << forecast.memory / 1'000'000U << " MB of memory for "
              << std::llround(forecast.samples) << " samples";
    if (forecast.quick_d0 > 0.0)
        std::cerr << "; --d0 " << forecast.quick_d0 << " would take about a minute and "
                  << forecast.quick_memory / 1'000'000U << " MB";
    std::cerr << ".\n";
}

// One line for the whole bake: how much is done, times, and the stage.
class BakeDisplay {
  public:
    explicit BakeDisplay(ProgressLine& line) : line_(line) {}

    void update(const bake::Progress& progress) {
        const double now = line_.seconds();
        progress_.update(progress, now);
        estimate_.update(progress_.fraction(now), now);
        line_.show([bake = progress_, estimate = estimate_](double seconds) {
            const double fraction = bake.fraction(seconds);
            return bar(fraction) + "  " + times_text(seconds, estimate.remaining(fraction, seconds)) + "  " +
                   bake.stage();
        });
    }

  private:
    ProgressLine& line_;
    maps::BakeProgress progress_;
    maps::TimeEstimate estimate_;
};

Result<bake::Baked> bake_shown(const scene::Scene& scene, const BakeOptions& options,
                               const std::stop_token& stop) {
    bake::Parameters parameters = options.parameters;
    parameters.memory = options.memory_mib == 0 ? maps::available_memory() : options.memory();
    if (options.quiet) return bake::bake(scene, parameters, {}, stop);
    ProgressLine line;
    BakeDisplay display(line);
    const auto show = [&](const bake::Progress& progress) { display.update(progress); };
    const auto finished = [&](const bake::StageReport& report) {
        line.clear();
        std::cerr << maps::line_of(report) << '\n';
    };
    const auto expected = [&](const bake::Forecast& forecast) {
        line.clear();
        print_forecast(forecast);
    };
    return bake::bake(scene, parameters, show, stop, finished, expected);
}

Result<void> bake_to_file(const BakeOptions& options) {
    const Interruption interruption;
    if (auto writable = check_outputs({options.output, options.report}, {options.map}); !writable)
        return writable;

    const auto scene = scene::load(options.map, options.read);
    if (!scene) return tl::unexpected(scene.error());
    if (!options.quiet) print_source(*scene, options.parameters);
    const auto baked = bake_shown(*scene, options, interruption.token());
    if (!baked) return tl::unexpected(baked.error());
    const std::vector<std::byte> bytes = freespace::encode(baked->contents);
    if (auto written = write_file(options.output, bytes); !written) return written;
    const maps::BakeReport report = maps::report_of(*scene, *baked, bytes.size());
    if (!options.report.empty()) {
        nlohmann::ordered_json json = maps::to_json(report);
        json["peak_memory_bytes"] = maps::peak_memory_bytes();
        if (auto written = write_file(options.report, config::format_json(json)); !written) return written;
    }
    if (!options.quiet)
        std::cerr << options.output << ": " << report.vertices << " vertices, " << report.triangles
                  << " triangles, " << report.file_bytes << " bytes in " << maps::seconds_text(report.seconds)
                  << ", at most " << maps::peak_memory_bytes() / 1'000'000U << " MB of memory\n";
    return {};
}

// The command has two forms: a map and an output, or a configuration.
void check_usage(const CLI::App& command, const BakeOptions& options) {
    if (command.count("--config") == 0) {
        for (const char* required : {"MAP", "--output"})
            if (command.count(required) == 0)
                throw CLI::RequiredError(std::string(required) + " (or --config alone)");
        return check_one_standard_output({{"--output", options.output}, {"--report", options.report}});
    }
    const std::set<std::string> in_both_forms{"help",    "config", "memory", "force",
                                              "threads", "report", "quiet"};
    for (const CLI::Option* option : command.get_options())
        if (option->count() > 0 && !in_both_forms.contains(option->get_single_name()))
            throw CLI::ExcludesError("--config", option->get_name());
}

int run_bake(const BakeOptions& options) {
    if (!options.config.empty())
        return bake_config({options.config, options.report, options.parameters.threads, options.memory(),
                            options.force, options.quiet});
    return exit_code_of(bake_to_file(options));
}

Vec3d checked_point(const std::string& option, const std::string& text) {
    const auto point = maps::parse_point(text);
    if (!point) throw CLI::ValidationError(option, "'" + text + "': expected three numbers, x,y,z");
    return *point;
}

// How the source is read.
void add_read_options(CLI::App& command, scene::ReadOptions& options) {
    command
        .add_option_function<double>(
            "--metres-per-unit", [&options](double value) { options.metres_per_unit = value; },
            "Length of a map unit; default: 0.0254 for a BSP, 1 for a mesh or a point cloud")
        ->check(number_between(config::min_metres_per_unit, config::max_metres_per_unit));
    command
        .add_option_function<std::string>(
            "--up", [&options](const std::string& axis) { options.up = scene::up_axis_named(axis); },
            "Axis of a mesh or a point cloud that points up: y or z; default: y for glTF, else z. With y, "
            "(x, y, z) becomes (z, x, y)")
        ->check(CLI::IsMember({"y", "z"}));
    command.add_option_function<std::string>(
        "--origin", [&options](const std::string& text) { options.origin = checked_point("--origin", text); },
        "x,y,z of a mesh or a point cloud, in its own axes, that becomes 0,0,0");
    command
        .add_option_function<std::vector<std::string>>(
            "--seed",
            [&options](const std::vector<std::string>& texts) {
                options.seeds.clear();
                for (const std::string& text : texts)
                    options.seeds.push_back(checked_point("--seed", text));
            },
            "x,y,z in the free space, in map units with z up, in addition to the map's spawn points; "
            "repeatable. Without seeds and spawn points the largest connected part is baked")
        ->type_name("X,Y,Z")
        ->allow_extra_args(false);
}

void add_memory_option(CLI::App& command, BakeOptions& options) {
    command
        .add_option("--memory", options.memory_mib,
                    "MiB that a bake may take: one that is expected to need more is refused after its first "
                    "stage. With --config, for all maps that are baked at the same time as well. 0: the "
                    "machine's memory, half of it for maps at the same time")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1} << 30U))
        ->capture_default_str();
}

// The form with --config.
void add_config_options(CLI::App& command, BakeOptions& options) {
    auto* config = command
                       .add_option("--config", options.config,
                                   "Bake the missing and stale maps of this configuration instead, each with "
                                   "the parameters and into the file given there")
                       ->type_name("FILE");
    command.add_flag("--force", options.force, "Bake maps that are not stale too")->needs(config);
}

}  // namespace

void add_bake(CLI::App& root, Run& run) {
    auto options = std::make_shared<BakeOptions>();
    CLI::App* command = root.add_subcommand(
        "bake", "Bake a map into a MAP.vfs, its freespace representation, or all maps of a configuration");
    command->add_option(
        "MAP", options->map,
        "Map file, or archive.pk3:maps/name.bsp: a BSP, a mesh (OBJ, PLY, STL, glTF) or a point "
        "cloud (PCD, PLY, XYZ, LAS)");
    command->add_option("-o,--output", options->output, "File to write; - is standard output");
    command
        ->add_option(
            "--d0", options->parameters.d0,
            "Sampling distance in units of 0.0254 m: openings narrower than about one and a half times this "
            "close. Default: 16; for a point cloud, whose surfaces it keeps away from, the points' spacing")
        ->check(number_between(bake::min_d0, bake::max_d0));
    add_read_options(*command, options->read);
    command
        ->add_option(
            "--loss", options->parameters.loss,
            "Mesh reduction: free distance that the centre of a ball may lose, in percent of the mean over "
            "the map, at most 3/2 d0; 0: no reduction")
        ->check(number_between(0.0, bake::max_loss))
        ->capture_default_str();
    command
        ->add_option("--triangles", options->parameters.triangles,
                     "End the reduction at this many triangles; 0: at the allowed loss")
        ->capture_default_str();
    command
        ->add_option_function<std::string>(
            "--sampling",
            [options](const std::string& name) {
                options->parameters.sampling = bake::sampling_named(name).value();
            },
            "adaptive: sparse where the free space is wide; uniform: d0 everywhere")
        ->check(CLI::IsMember({"adaptive", "uniform"}))
        ->default_str(std::string(name_of(bake::Sampling::adaptive)));
    command->add_option("--threads", options->parameters.threads, "Number of threads; 0: one per core")
        ->check(CLI::Range(0U, 1024U))
        ->capture_default_str();
    command->add_flag("--quiet", options->quiet, "Print only errors");
    command->add_option("--report", options->report,
                        "Write seconds and counts of each stage and the peak of memory as JSON");
    add_memory_option(*command, *options);
    add_config_options(*command, *options);
    command->callback([options, command, &run] {
        check_usage(*command, *options);
        run = [options] { return run_bake(*options); };
    });
}

}  // namespace camdir::app
