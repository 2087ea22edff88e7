#include "app/bake_config.hpp"

#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>
#include <vector>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "base/file.hpp"
#include "base/signals.hpp"
#include "config/json_text.hpp"
#include "maps/batch.hpp"
#include "maps/memory.hpp"
#include "maps/progress.hpp"

namespace camdir::app {
namespace {

using nlohmann::ordered_json;

std::string figures(const maps::BakeOutcome& outcome) {
    return std::to_string(outcome.samples) + " samples, " + std::to_string(outcome.triangles) +
           " triangles, " + std::to_string(outcome.file_bytes) + " bytes";
}

std::string line_of(const maps::BakeOutcome& outcome) {
    std::string line = outcome.map + ": " + std::string(name_of(outcome.status));
    if (outcome.status == maps::BakeStatus::baked)
        return line + " in " + maps::seconds_text(outcome.seconds) + ": " + figures(outcome);
    return outcome.reason.empty() ? line : line + ": " + outcome.reason;
}

// How far the maps of a batch are. A value.
struct BatchProgress {
    std::size_t to_bake = 0;
    std::size_t finished = 0;
    std::map<std::string, maps::BakeProgress> running;  // by the map's name
    maps::TimeEstimate estimate;

    // Every map counts the same.
    [[nodiscard]] double fraction(double seconds) const {
        auto done = static_cast<double>(finished);
        for (const auto& [map, progress] : running)
            done += progress.fraction(seconds);
        return done / static_cast<double>(std::max<std::size_t>(to_bake, 1));
    }

    [[nodiscard]] std::string text(double seconds) const {
        const double done = fraction(seconds);
        std::string line = bar(done) + "  " + times_text(seconds, estimate.remaining(done, seconds));
        if (to_bake > 1) line += "  " + std::to_string(finished) + " of " + std::to_string(to_bake) + " maps";
        for (const auto& [map, progress] : running)
            line += "  " + map + " " + progress.stage();
        return line;
    }
};

// Shows a line with the progress of the batch, and prints a line for each map that is finished.
class BatchDisplay {
  public:
    explicit BatchDisplay(bool quiet) : quiet_(quiet) {}

    void examined(std::size_t to_bake) { batch_.to_bake = to_bake; }

    void progress(const std::string& map, const bake::Progress& progress) {
        batch_.running[map].update(progress, line_.seconds());
        show();
    }

    void finished(const maps::BakeOutcome& outcome) {
        if (batch_.running.erase(outcome.map) > 0) ++batch_.finished;
        if (quiet_ && outcome.status != maps::BakeStatus::failed) return;
        line_.clear();
        std::cerr << line_of(outcome) << '\n';
        show();
    }

  private:
    void show() {
        if (quiet_ || batch_.running.empty()) return;
        const double now = line_.seconds();
        batch_.estimate.update(batch_.fraction(now), now);
        line_.show([batch = batch_](double seconds) { return batch.text(seconds); });
    }

    const bool quiet_;
    BatchProgress batch_;
    ProgressLine line_;
};

void print_table(const std::vector<maps::BakeOutcome>& outcomes) {
    std::size_t width = 3;
    for (const maps::BakeOutcome& outcome : outcomes)
        width = std::max(width, outcome.map.size());
    std::ostringstream table;
    table << '\n'
          << std::left << std::setw(static_cast<int>(width)) << "map"
          << "  state        " << std::right << std::setw(10) << "seconds" << std::setw(11) << "samples"
          << std::setw(11) << "triangles" << std::setw(12) << "bytes"
          << "  reason\n";
    for (const maps::BakeOutcome& outcome : outcomes)
        table << std::left << std::setw(static_cast<int>(width)) << outcome.map << "  " << std::setw(13)
              << name_of(outcome.status) << std::right << std::setw(10) << std::fixed << std::setprecision(2)
              << outcome.seconds << std::setw(11) << outcome.samples << std::setw(11) << outcome.triangles
              << std::setw(12) << outcome.file_bytes << "  " << outcome.reason << '\n';
    std::cerr << table.str();
}

ordered_json json_of(const maps::BakeOutcome& outcome) {
    ordered_json json = {{"map", outcome.map},
                         {"state", name_of(outcome.status)},
                         {"reason", outcome.reason},
                         {"seconds", outcome.seconds},
                         {"samples", outcome.samples},
                         {"triangles", outcome.triangles},
                         {"file_bytes", outcome.file_bytes}};
    if (outcome.report) json["bake"] = maps::to_json(*outcome.report);
    return json;
}

Result<void> write_report(const BakeConfigOptions& options, const maps::BatchParameters& parameters,
                          double seconds, const std::vector<maps::BakeOutcome>& outcomes) {
    if (options.report.empty()) return {};
    ordered_json maps = ordered_json::array();
    for (const maps::BakeOutcome& outcome : outcomes)
        maps.push_back(json_of(outcome));
    const ordered_json report = {{"config", options.config},
                                 {"memory_budget_bytes", parameters.memory},
                                 {"peak_memory_bytes", maps::peak_memory_bytes()},
                                 {"seconds", seconds},
                                 {"maps", maps}};
    return write_file(options.report, config::format_json(report));
}

int batch_exit_code(const std::vector<maps::BakeOutcome>& outcomes) {
    const auto any = [&](maps::BakeStatus status) {
        return std::any_of(outcomes.begin(), outcomes.end(),
                           [&](const maps::BakeOutcome& outcome) { return outcome.status == status; });
    };
    if (any(maps::BakeStatus::interrupted)) return exit_interrupted;
    return any(maps::BakeStatus::failed) ? exit_failed : exit_done;
}

Result<int> run(const BakeConfigOptions& options) {
    const Interruption interruption;
    if (auto writable = check_outputs({options.report}, {options.config}); !writable)
        return tl::unexpected(writable.error());
    auto config = config::load(options.config);
    if (!config) return tl::unexpected(config.error());
    std::vector<config::Map> maps;
    std::copy_if(config->maps.begin(), config->maps.end(), std::back_inserter(maps),
                 [](const config::Map& map) { return !map.source.empty(); });
    if (maps.empty() && !options.quiet) std::cerr << options.config << ": no map has a source to bake\n";

    const maps::BatchParameters parameters{
        options.threads, options.memory == 0 ? maps::available_memory() / 2 : options.memory,
        options.memory == 0 ? maps::available_memory() : options.memory, options.force};
    BatchDisplay display(options.quiet);
    const maps::BatchSink sink{
        [&](std::size_t to_bake) { display.examined(to_bake); },
        [&](const std::string& map, const bake::Progress& p) { display.progress(map, p); },
        [&](const maps::BakeOutcome& outcome) { display.finished(outcome); }};
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<maps::BakeOutcome> outcomes =
        maps::bake_maps(maps, parameters, sink, interruption.token());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    if (!options.quiet && !maps.empty()) print_table(outcomes);
    auto written = write_report(options, parameters, seconds.count(), outcomes);
    if (!written) return tl::unexpected(written.error());
    return batch_exit_code(outcomes);
}

}  // namespace

int bake_config(const BakeConfigOptions& options) {
    const Result<int> code = run(options);
    return code ? *code : report(code.error());
}

}  // namespace camdir::app
