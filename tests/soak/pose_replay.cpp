// pose-replay: plays a recorded match as any number of live ones.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "evaluation/resample.hpp"
#include "evaluation/trace.hpp"
#include "load.hpp"
#include "program.hpp"

namespace camdir::soak {
namespace {

struct Options {
    std::string trace;
    double rate_hz = 0.0;
    std::uint32_t copies = 1;
    Load load;
};

// Frames per second of a recording.
double rate_of(const evaluation::Trace& trace) {
    const auto span = trace.frames.back().time - trace.frames.front().time;
    return 1e9 * static_cast<double>(trace.frames.size() - 1) / static_cast<double>(span);
}

// Plays the trace over and over, beginning at frame `first`. Where it wraps around, all players jump.
Players replay(std::shared_ptr<const evaluation::Trace> trace, std::size_t first) {
    return [trace = std::move(trace), first](std::uint64_t frame, PoseArrays& poses) {
        const std::size_t at = (first + frame) % trace->frames.size();
        for (const evaluation::TracePose& pose : trace->poses_of(trace->frames[at])) {
            const bool jumped = pose.discontinuity || at == 0;
            poses.add(pose.player, pose.eye.cast<float>(), pose.orientation.cast<float>(),
                      pose.velocity.cast<float>(), (pose.alive ? 1U : 0U) | (jumped ? 2U : 0U));
        }
    };
}

int play(Options options, const std::stop_token& stop) {
    auto trace = evaluation::read_trace(options.trace);
    if (!trace) {
        std::cerr << "pose-replay: " << trace.error().message << '\n';
        return 1;
    }
    if (trace->frames.size() < 2) {
        std::cerr << "pose-replay: " << options.trace << ": fewer than two frames\n";
        return 1;
    }
    const double recorded_hz = rate_of(*trace);
    options.load.rate_hz = options.rate_hz > 0.0 ? options.rate_hz : recorded_hz * options.load.speed;
    // At the times of the frames that will be sent.
    trace = evaluation::resample(*trace, options.load.rate_hz / options.load.speed);
    if (!trace) {
        std::cerr << "pose-replay: " << trace.error().message << '\n';
        return 1;
    }
    const auto players = static_cast<std::uint32_t>(trace->players.back() + 1);
    const auto shared = std::make_shared<const evaluation::Trace>(std::move(*trace));
    for (std::uint32_t copy = 0; copy < options.copies; ++copy) {
        // Copies start at different frames, so that their load peaks do not coincide.
        options.load.matches.push_back(replay(shared, shared->frames.size() * copy / options.copies));
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
    app.add_option("--map-name", options.load.map_name, "The map's name in the director's configuration")
        ->required();
    app.add_option("--copies", options.copies, "Matches")->check(CLI::Range(1, 4096))->capture_default_str();
    app.add_option("--match-prefix", options.load.match_prefix, "Matches are PREFIX-0, PREFIX-1, ...")
        ->capture_default_str();
    app.add_option("--rate", options.rate_hz, "Frames sent per second; 0: as recorded")
        ->check(CLI::Range(0.0, 1000.0))
        ->capture_default_str();
    app.add_option("--speed", options.load.speed, "Of the game relative to real time")
        ->check(CLI::Range(0.01, 100.0))
        ->capture_default_str();
    app.add_option("--delay", options.load.delay_s, "Spectator delay, s")
        ->check(CLI::Range(0.0, 600.0))
        ->capture_default_str();
    app.add_option("--metres-per-unit", options.load.metres_per_unit)->capture_default_str();
    app.add_option("--seconds", options.load.seconds, "Duration; 0: until interrupted")
        ->check(CLI::NonNegativeNumber);
    options.load.network.add_options(app);
    return soak::run_until_interrupted(
        app, argc, argv, [&](const std::stop_token& stop) { return soak::play(std::move(options), stop); });
}
