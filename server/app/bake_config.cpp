#include "app/bake_config.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>
#include <vector>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "app/writable.hpp"
#include "base/file.hpp"
#include "maps/batch.hpp"
#include "service/interruption.hpp"

namespace camdir::app {
namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t mebibyte = 1024U * 1024U;

std::string figures(const maps::MapOutcome& outcome) {
    return std::to_string(outcome.samples) + " samples, " + std::to_string(outcome.triangles) +
           " triangles, " + std::to_string(outcome.file_bytes) + " bytes";
}

std::string line_of(const maps::MapOutcome& outcome) {
    std::string line = outcome.map + ": " + std::string(name_of(outcome.state));
    if (outcome.state == maps::MapState::baked)
        return line + " in " + maps::seconds_text(outcome.seconds) + ": " + figures(outcome);
    return outcome.reason.empty() ? line : line + ": " + outcome.reason;
}

// Tells how the batch goes: a line that is rewritten with the running maps, and a line a map that ended.
class BatchDisplay {
  public:
    explicit BatchDisplay(bool quiet) : quiet_(quiet) {}

    void examined(std::size_t to_bake) { to_bake_ = to_bake; }

    void progress(const std::string& map, const bake::Progress& progress) {
        std::string& text = running_[map];
        text = map + " " + std::string(progress.stage);
        // A map alone has the bar for its stages.
        if (to_bake_ == 1 && !quiet_) return line_.show(text, progress.done, progress.total);
        if (progress.total > 0) text += " " + std::to_string(100 * progress.done / progress.total) + " %";
        draw();
    }

    void finished(const maps::MapOutcome& outcome) {
        if (running_.erase(outcome.map) > 0) ++baked_;
        if (quiet_ && outcome.state != maps::MapState::failed) return;
        line_.clear();
        std::cerr << line_of(outcome) << '\n';
        draw();
    }

  private:
    void draw() {
        if (quiet_ || running_.empty()) return;
        std::string text = std::to_string(baked_) + " of " + std::to_string(to_bake_) + " maps " +
                           bar(baked_, std::max<std::size_t>(to_bake_, 1)) + " ";
        for (const auto& [map, state] : running_)
            text += "  " + state;
        line_.show(text);
    }

    const bool quiet_;
    std::size_t to_bake_ = 0;
    std::size_t baked_ = 0;
    std::map<std::string, std::string> running_;  // by the map's name, how far it is
    ProgressLine line_;
};

void print_table(const std::vector<maps::MapOutcome>& outcomes) {
    std::size_t width = 3;
    for (const maps::MapOutcome& outcome : outcomes)
        width = std::max(width, outcome.map.size());
    std::ostringstream table;
    table << '\n'
          << std::left << std::setw(static_cast<int>(width)) << "map"
          << "  state        " << std::right << std::setw(10) << "seconds" << std::setw(11) << "samples"
          << std::setw(11) << "triangles" << std::setw(12) << "bytes"
          << "  reason\n";
    for (const maps::MapOutcome& outcome : outcomes)
        table << std::left << std::setw(static_cast<int>(width)) << outcome.map << "  " << std::setw(13)
              << name_of(outcome.state) << std::right << std::setw(10) << std::fixed << std::setprecision(2)
              << outcome.seconds << std::setw(11) << outcome.samples << std::setw(11) << outcome.triangles
              << std::setw(12) << outcome.file_bytes << "  " << outcome.reason << '\n';
    std::cerr << table.str();
}

ordered_json json_of(const maps::MapOutcome& outcome) {
    ordered_json json = {{"map", outcome.map},
                         {"state", name_of(outcome.state)},
                         {"reason", outcome.reason},
                         {"seconds", outcome.seconds},
                         {"samples", outcome.samples},
                         {"triangles", outcome.triangles},
                         {"file_bytes", outcome.file_bytes}};
    if (outcome.report) json["bake"] = maps::to_json(*outcome.report);
    return json;
}

Result<void> write_report(const BakeConfigOptions& options, const maps::BatchParameters& parameters,
                          double seconds, const std::vector<maps::MapOutcome>& outcomes) {
    if (options.report.empty()) return {};
    ordered_json maps = ordered_json::array();
    for (const maps::MapOutcome& outcome : outcomes)
        maps.push_back(json_of(outcome));
    const ordered_json report = {{"config", options.config},
                                 {"memory_budget_bytes", parameters.memory},
                                 {"peak_memory_bytes", maps::peak_memory_bytes()},
                                 {"seconds", seconds},
                                 {"maps", maps}};
    return write_file(options.report, maps::report_text(report));
}

int exit_code_of(const std::vector<maps::MapOutcome>& outcomes) {
    const auto any = [&](maps::MapState state) {
        return std::any_of(outcomes.begin(), outcomes.end(),
                           [&](const maps::MapOutcome& outcome) { return outcome.state == state; });
    };
    if (any(maps::MapState::interrupted)) return exit_interrupted;
    return any(maps::MapState::failed) ? exit_failed : exit_done;
}

Result<int> run(const BakeConfigOptions& options) {
    const service::Interruption interruption;
    if (auto writable = check_writable(options.report); !writable) return tl::unexpected(writable.error());
    auto config = config::load(options.config);
    if (!config) return tl::unexpected(config.error());
    std::vector<config::Map> maps;
    std::copy_if(config->maps.begin(), config->maps.end(), std::back_inserter(maps),
                 [](const config::Map& map) { return !map.source.empty(); });
    if (maps.empty() && !options.quiet) std::cerr << options.config << ": no map has a source to bake\n";

    const maps::BatchParameters parameters{
        options.threads, options.memory_mib == 0 ? default_memory() : options.memory_mib * mebibyte,
        options.force};
    BatchDisplay display(options.quiet);
    const maps::BatchSink sink{
        [&](std::size_t to_bake) { display.examined(to_bake); },
        [&](const std::string& map, const bake::Progress& p) { display.progress(map, p); },
        [&](const maps::MapOutcome& outcome) { display.finished(outcome); }};
    const auto begin = std::chrono::steady_clock::now();
    const std::vector<maps::MapOutcome> outcomes =
        maps::bake_maps(maps, parameters, sink, interruption.token());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    if (!options.quiet && !maps.empty()) print_table(outcomes);
    auto written = write_report(options, parameters, seconds.count(), outcomes);
    if (!written) return tl::unexpected(written.error());
    return exit_code_of(outcomes);
}

// This process's, "/" where there is none: the line "0::/path" of its groups.
std::filesystem::path control_group() {
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);)
        if (line.starts_with("0::/")) return line.substr(3);
    return "/";
}

}  // namespace

std::uint64_t default_memory() {
    std::uint64_t memory = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                           static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    for (std::filesystem::path group = control_group();; group = group.parent_path()) {
        // "max" where there is no limit.
        std::ifstream file("/sys/fs/cgroup" + group.string() + "/memory.max");
        if (std::uint64_t limit = 0; file >> limit) memory = std::min(memory, limit);
        if (!group.has_relative_path()) return memory / 2;
    }
}

int bake_config(const BakeConfigOptions& options) {
    const Result<int> code = run(options);
    return code ? *code : report(code.error());
}

}  // namespace camdir::app
