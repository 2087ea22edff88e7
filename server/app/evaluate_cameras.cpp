#include "app/evaluate_cameras.hpp"

#include <array>
#include <cstdio>
#include <filesystem>

#include "config/config.hpp"
#include "evaluation/peers.hpp"

namespace camdir::app {
namespace {

using camera::Solver;

constexpr const char* rigid = "rigid";

Result<camera::Profile> find_profile(const EvaluateOptions& options) {
    const auto config = options.config.empty() ? config::parse("{}", "", "") : config::load(options.config);
    if (!config) return tl::unexpected(config.error());
    const auto found = config->profiles.find(options.profile);
    if (found != config->profiles.end()) return found->second;
    std::string names;
    for (const auto& [name, profile] : config->profiles)
        names += " " + name;
    return fail((options.config.empty() ? "--profile" : options.config + ": /profiles") + ": there is no \"" +
                options.profile + "\"; there are" + names);
}

// The options' solver, or the other one.
enum class Choice { chosen, other };

std::string name_of(const EvaluateOptions& options, Solver solver) {
    std::string name = solver == Solver::planner ? planner : paper;
    if (options.profile != "default") name += " " + options.profile;
    if (options.look_ahead == 0.0) return name;
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), " %g s ahead", options.look_ahead);
    return name + seconds.data();
}

Result<NamedRecording> run_tracker(const EvaluateOptions& options, Choice choice, const Match& match,
                                   const SourceMap& map, ProgressLine& line, const std::stop_token& stop) {
    auto profile = choose_profile(options);
    if (!profile) return tl::unexpected(profile.error());
    if (choice == Choice::other)
        profile->solver = profile->solver == Solver::planner ? Solver::paper : Solver::planner;
    const auto show = [&](std::uint64_t done, std::uint64_t total) { line.show("tracking", done, total); };
    const auto movers = match.movers ? std::span<const evaluation::MoverRow>(*match.movers)
                                     : std::span<const evaluation::MoverRow>();
    auto recording = evaluation::record(*map.freespace, *profile, match.poses, movers, match.frames,
                                        options.look_ahead, show, stop);
    if (!recording) return tl::unexpected(recording.error());
    return NamedRecording{name_of(options, profile->solver), std::move(*recording)};
}

NamedRecording run_peer(const std::string& name, const Match& match, const SourceMap& map) {
    NamedRecording made{name, {}};
    made.recording.cameras =
        evaluation::follow(*evaluation::find_peer(name), match.frames, map.scene.metres_per_unit);
    return made;
}

}  // namespace

Result<camera::Profile> choose_profile(const EvaluateOptions& options) {
    auto profile = find_profile(options);
    if (profile && !options.solver.empty())
        profile->solver = options.solver == planner ? Solver::planner : Solver::paper;
    return profile;
}

Result<NamedRecording> make_cameras(const EvaluateOptions& options, const Match& match, const SourceMap& map,
                                    ProgressLine& line, const std::stop_token& stop) {
    if (options.tracks()) return run_tracker(options, Choice::chosen, match, map, line, stop);
    if (options.judge.empty()) return run_peer(options.camera, match, map);
    auto cameras = evaluation::read_cameras(options.judge, match.frames);
    if (!cameras) return tl::unexpected(cameras.error());
    NamedRecording made{std::filesystem::path(options.judge).filename().string(), {}};
    made.recording.cameras = std::move(*cameras);
    return made;
}

Result<std::vector<NamedRecording>> make_compared_cameras(const EvaluateOptions& options, const Match& match,
                                                          const SourceMap& map, ProgressLine& line,
                                                          const std::stop_token& stop) {
    std::vector<NamedRecording> made;
    if (map.freespace) {
        auto tracked =
            run_tracker(options, options.tracks() ? Choice::other : Choice::chosen, match, map, line, stop);
        if (!tracked) return tl::unexpected(tracked.error());
        made.push_back(std::move(*tracked));
    }
    if (!options.judge.empty() || options.camera != rigid) made.push_back(run_peer(rigid, match, map));
    return made;
}

}  // namespace camdir::app
