// pose-replay: plays a recorded match as any number of live ones.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <utility>

#include "app/number_between.hpp"
#include "evaluation/events.hpp"
#include "evaluation/match.hpp"
#include "evaluation/resample.hpp"
#include "load.hpp"
#include "program.hpp"
#include "replay.hpp"

namespace camdir::soak {
namespace {

struct Options {
    std::string trace;
    std::string events;  // a table of them; empty: the match's own
    double rate_hz = 0.0;
    std::uint32_t copies = 1;
    Load load;
};

// Frames per second of a recording.
double rate_of(const evaluation::Trace& trace) {
    const auto span = trace.frames.back().time - trace.frames.front().time;
    return 1e9 * static_cast<double>(trace.frames.size() - 1) / static_cast<double>(span);
}

Result<evaluation::RecordedMatch> read(const Options& options) {
    auto match = evaluation::read_match(options.trace);
    if (!match) return match;
    if (!match->warning.empty()) std::cerr << "pose-replay: warning: " << match->warning << '\n';
    if (match->trace.frames.size() < 2) return fail(options.trace + ": fewer than two frames");
    if (options.events.empty()) return match;
    auto events = evaluation::read_events(options.events, match->trace, is_sent);
    if (!events) return tl::unexpected(events.error());
    match->events = std::move(*events);
    return match;
}

int failed(const Error& error) {
    std::cerr << "pose-replay: " << error.message << '\n';
    return 1;
}

int play(Options options, const std::stop_token& stop) {
    auto match = read(options);
    if (!match) return failed(match.error());
    const double recorded_hz = rate_of(match->trace);
    options.load.rate_hz = options.rate_hz > 0.0 ? options.rate_hz : recorded_hz * options.load.speed;
    // At the times of the frames that will be sent.
    auto trace = evaluation::resample(match->trace, options.load.rate_hz / options.load.speed);
    if (!trace) return failed(trace.error());
    match->trace = std::move(*trace);
    const auto players = static_cast<std::uint32_t>(match->trace.players.back() + 1);
    const std::size_t frames = match->trace.frames.size();
    const auto shared = std::make_shared<const evaluation::RecordedMatch>(std::move(*match));
    for (std::uint32_t copy = 0; copy < options.copies; ++copy) {
        // Copies start at different frames, so that their load peaks do not coincide.
        options.load.matches.push_back(replay(shared, frames * copy / options.copies));
    }
    return run(options.load, std::min(players, 256U), stop);
}

}  // namespace
}  // namespace camdir::soak

int main(int argc, char** argv) {
    using namespace camdir;
    soak::Options options;
    CLI::App app("Plays a recorded match as any number of live ones, over and over.", "pose-replay");
    app.add_option("trace", options.trace, "The recorded match, CSV or .mvd, perhaps .gz")->required();
    app.add_option("--events", options.events,
                   "What happened in it, CSV, perhaps .gz; without it what the recording itself has");
    app.add_option("--map-name", options.load.map_name, "The map's name in the director's configuration")
        ->required();
    app.add_option("--copies", options.copies, "Matches")->check(CLI::Range(1, 4096))->capture_default_str();
    app.add_option("--rate", options.rate_hz, "Frames sent per second, 0.1 or more; 0: as recorded")
        ->check(app::number_between(0.1, 1000.0) | app::number_between(0.0, 0.0))
        ->capture_default_str();
    app.add_option("--metres-per-unit", options.load.metres_per_unit)->capture_default_str();
    options.load.add_options(app);
    return soak::run_until_interrupted(
        app, argc, argv, [&](const std::stop_token& stop) { return soak::play(std::move(options), stop); });
}
