// camera-director bake: a map file becomes a MAP.vfs.
#include <sys/resource.h>

#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/writable.hpp"
#include "bake/bake.hpp"
#include "base/file.hpp"
#include "freespace/freespace.hpp"
#include "scene/load.hpp"

namespace camdir::app {
namespace {

struct Options {
    std::string map;
    std::string output;
    std::string report;
    bake::Parameters parameters;
    bool quiet = false;
};

std::string seconds_text(double seconds) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << seconds << " s";
    return text.str();
}

std::string line_of(const bake::StageReport& report) {
    std::ostringstream line;
    line << std::left << std::setw(12) << report.stage << std::right << std::setw(9)
         << seconds_text(report.seconds);
    const char* separator = "  ";
    for (const freespace::Count& count : report.counts) {
        line << separator << std::fixed << std::setprecision(0) << count.value << ' ' << count.what;
        separator = ", ";
    }
    return line.str();
}

double total_seconds(const bake::Baked& baked) {
    double sum = 0.0;
    for (const bake::StageReport& stage : baked.stages)
        sum += stage.seconds;
    return sum;
}

std::uint64_t peak_memory_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
}

std::string report_json(const Options& options, const scene::Scene& scene, const bake::Baked& baked,
                        std::size_t bytes) {
    nlohmann::ordered_json stages = nlohmann::ordered_json::array();
    for (const bake::StageReport& stage : baked.stages) {
        nlohmann::ordered_json counts = nlohmann::ordered_json::object();
        for (const freespace::Count& count : stage.counts)
            counts[count.what] = count.value;
        stages.push_back({{"stage", stage.stage}, {"seconds", stage.seconds}, {"counts", counts}});
    }
    const nlohmann::ordered_json report{
        {"map", scene.name},
        {"source", scene.source},
        {"metres_per_unit", scene.metres_per_unit},
        {"d0", options.parameters.d0},
        {"loss", options.parameters.loss},
        {"d0_map_units", baked.contents.metadata.d0},
        {"vertices", baked.contents.vertices.size()},
        {"triangles", baked.contents.triangles.size()},
        {"file_bytes", bytes},
        {"seconds", total_seconds(baked)},
        {"peak_memory_bytes", peak_memory_bytes()},
        {"stages", stages},
    };
    // Names of files need not be UTF-8.
    return report.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result<bake::Baked> bake_shown(const scene::Scene& scene, const Options& options,
                               const std::stop_token& stop) {
    if (options.quiet) return bake::bake(scene, options.parameters, {}, stop);
    ProgressLine line;
    const auto show = [&](const bake::Progress& p) { line.show(p.stage, p.done, p.total); };
    const auto finished = [&](const bake::StageReport& report) {
        line.clear();
        std::cerr << line_of(report) << '\n';
    };
    return bake::bake(scene, options.parameters, show, stop, finished);
}

Result<void> bake_to_file(const Options& options) {
    const Interruption interruption;
    for (const std::string& file : {options.output, options.report})
        if (auto writable = check_writable(file); !writable) return writable;

    const auto scene = scene::load(options.map);
    if (!scene) return tl::unexpected(scene.error());
    const auto baked = bake_shown(*scene, options, interruption.token());
    if (!baked) return tl::unexpected(baked.error());
    const std::vector<std::byte> bytes = freespace::encode(baked->contents);
    if (auto written = write_file(options.output, bytes); !written) return written;
    if (!options.report.empty()) {
        auto written = write_file(options.report, report_json(options, *scene, *baked, bytes.size()));
        if (!written) return written;
    }
    if (!options.quiet)
        std::cerr << options.output << ": " << baked->contents.vertices.size() << " vertices, "
                  << baked->contents.triangles.size() << " triangles, " << bytes.size() << " bytes in "
                  << seconds_text(total_seconds(*baked)) << ", at most " << peak_memory_bytes() / 1'000'000U
                  << " MB of memory\n";
    return {};
}

}  // namespace

void add_bake(CLI::App& root, Run& run) {
    auto options = std::make_shared<Options>();
    CLI::App* command = root.add_subcommand("bake", "Make a MAP.vfs, the freespace of a map");
    command->add_option("MAP", options->map, "Map file, or archive.pk3:maps/name.bsp")->required();
    command->add_option("-o,--output", options->output, "File to write; - is standard output")->required();
    command
        ->add_option("--d0", options->parameters.d0,
                     "Sampling distance in units of 0.0254 m: openings narrower than about twice of it close")
        ->check(CLI::Range(bake::min_d0, bake::max_d0))
        ->capture_default_str();
    command
        ->add_option(
            "--loss", options->parameters.loss,
            "Mesh reduction: free distance that the centre of a ball may lose, in percent of it and of "
            "6 d0; 0 keeps the whole mesh")
        ->check(CLI::Range(0.0, bake::max_loss))
        ->capture_default_str();
    command
        ->add_option("--triangles", options->parameters.triangles,
                     "End the reduction at this many triangles; 0 goes on to the allowed loss")
        ->capture_default_str();
    command->add_option("--threads", options->parameters.threads, "0 is one a core")
        ->check(CLI::Range(0U, 1024U))
        ->capture_default_str();
    command->add_flag("--quiet", options->quiet, "Print nothing but errors");
    command->add_option("--report", options->report,
                        "Write seconds and counts of each stage and the peak of memory as JSON");
    command->callback([options, &run] {
        run = [options] {
            const auto done = bake_to_file(*options);
            return done ? exit_done : report(done.error());
        };
    });
}

}  // namespace camdir::app
