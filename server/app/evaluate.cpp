// camera-director evaluate: measures the cameras of a recorded match against its map.
#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "base/file.hpp"
#include "config/config.hpp"
#include "evaluation/kills.hpp"
#include "evaluation/metrics.hpp"
#include "evaluation/peers.hpp"
#include "evaluation/recording.hpp"
#include "evaluation/report.hpp"
#include "evaluation/resample.hpp"
#include "evaluation/statistics.hpp"
#include "freespace/freespace.hpp"
#include "maps/source.hpp"
#include "oracle/oracle.hpp"
#include "scene/load.hpp"
#include "service/signals.hpp"

namespace camdir::app {
namespace {

constexpr const char* tracker = "tracker";
constexpr const char* planner = "planner";
constexpr const char* paper = "paper";

struct EvaluateOptions {
    std::string freespace;
    std::string map;
    std::string trace;
    std::string events;
    std::string camera = tracker;
    std::string judge;
    std::string profile = "default";
    std::string config;
    std::string cameras;
    std::string terms;
    std::string json;
    double output_hz = 0.0;  // 0 = the trace's own frames
    double look_ahead = 0.0;
    std::string solver;  // empty: the profile's

    [[nodiscard]] bool tracks() const { return judge.empty() && camera == tracker; }
};

void check_usage(const EvaluateOptions& options) {
    if (options.tracks() && options.freespace.empty())
        throw CLI::RequiredError("FILE.vfs, or --camera with another camera than the tracker, or --judge");
    if (!options.tracks() && (!options.config.empty() || options.profile != "default"))
        throw CLI::ValidationError("--config and --profile", "only the tracker has a profile");
    if (!options.tracks() && (!options.solver.empty() || options.look_ahead > 0.0))
        throw CLI::ValidationError("--solver and --look-ahead", "only the tracker has a solver");
    if (!options.tracks() && !options.terms.empty())
        throw CLI::ValidationError("--terms", "only the tracker has an objective");
    check_one_standard_output(
        {{"--cameras", options.cameras}, {"--terms", options.terms}, {"--json", options.json}});
}

struct Match {
    evaluation::Trace poses;   // as recorded
    evaluation::Trace frames;  // the instants of the cameras
    std::optional<std::vector<evaluation::Kill>> kills;
};

Result<Match> read_match(const EvaluateOptions& options) {
    auto trace = evaluation::read_trace(options.trace);
    if (!trace) return tl::unexpected(trace.error());
    Match match;
    if (!options.events.empty()) {
        auto kills = evaluation::read_kills(options.events, *trace);
        if (!kills) return tl::unexpected(kills.error());
        match.kills = std::move(*kills);
    }
    auto frames = options.output_hz == 0.0 ? Result<evaluation::Trace>(*trace)
                                           : evaluation::resample(*trace, options.output_hz);
    if (!frames) return fail(options.trace + ": " + frames.error().message);
    match.poses = std::move(*trace);
    match.frames = std::move(*frames);
    return match;
}

struct SourceMap {
    scene::Scene scene;
    double point_radius = 0.0;  // of the obstacles in a cloud
};

// The baked file holds the options for reading a mesh or a point cloud.
Result<SourceMap> open_map(const EvaluateOptions& options) {
    if (options.freespace.empty()) {
        auto scene = scene::load(options.map);
        if (!scene) return tl::unexpected(scene.error());
        if (scene->points.empty()) return SourceMap{std::move(*scene)};
        return fail(options.map +
                    ": is a point cloud; name the FILE.vfs too, which says how far its "
                    "surfaces may be from its points");
    }
    const auto freespace = freespace::Freespace::open(options.freespace);
    if (!freespace) return tl::unexpected(freespace.error());
    auto scene = maps::load_source(*freespace, options.map);
    if (!scene) return tl::unexpected(scene.error());
    return SourceMap{std::move(*scene), freespace->metadata().d0};
}

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

Result<evaluation::Recording> run_tracker(const EvaluateOptions& options, const Match& match,
                                          std::uint64_t map_hash, ProgressLine& line,
                                          const std::stop_token& stop) {
    auto profile = find_profile(options);
    if (!profile) return tl::unexpected(profile.error());
    if (!options.solver.empty())
        profile->solver = options.solver == planner ? camera::Solver::planner : camera::Solver::paper;
    const auto freespace = freespace::Freespace::open(options.freespace);
    if (!freespace) return tl::unexpected(freespace.error());
    if (freespace->metadata().source_hash != map_hash) {
        line.clear();
        std::cerr << "camera-director: warning: " << options.freespace << " was baked from another file than "
                  << options.map << '\n';
    }
    const auto show = [&](std::uint64_t done, std::uint64_t total) { line.show("tracking", done, total); };
    return evaluation::record(*freespace, *profile, match.poses, match.frames, options.look_ahead, show,
                              stop);
}

// The cameras to measure. Only the tracker's have objective terms and times.
Result<evaluation::Recording> make_cameras(const EvaluateOptions& options, const Match& match,
                                           const scene::Scene& scene, ProgressLine& line,
                                           const std::stop_token& stop) {
    if (options.tracks()) return run_tracker(options, match, scene.source_hash, line, stop);
    evaluation::Recording recording;
    if (options.judge.empty()) {
        const auto peer = evaluation::find_peer(options.camera);
        recording.cameras = evaluation::follow(*peer, match.frames, scene.metres_per_unit);
        return recording;
    }
    auto cameras = evaluation::read_cameras(options.judge, match.frames);
    if (!cameras) return tl::unexpected(cameras.error());
    recording.cameras = std::move(*cameras);
    return recording;
}

void print(const EvaluateOptions& options, const evaluation::Trace& trace, const evaluation::Metrics& metrics,
           const evaluation::Recording& recording) {
    std::cerr << options.trace << ": " << trace.players.size() << " players, " << trace.frames.size()
              << " frames\n"
              << evaluation::to_table(metrics);
    if (recording.step_nanoseconds.empty()) return;
    std::cerr << "cost             median "
              << std::llround(evaluation::percentile(recording.step_nanoseconds, 0.5)) << "  p99 "
              << std::llround(evaluation::percentile(recording.step_nanoseconds, 0.99)) << "  mean "
              << std::llround(evaluation::mean(recording.step_nanoseconds)) << " ns of CPU time an update\n";
}

Result<void> write_results(const EvaluateOptions& options, const evaluation::Trace& trace,
                           const evaluation::Metrics& metrics, const evaluation::Recording& recording) {
    Result<void> written;
    if (written && !options.cameras.empty())
        written = write_file(options.cameras, evaluation::format_cameras(trace, recording.cameras));
    if (written && !options.terms.empty())
        written = write_file(options.terms, evaluation::format_terms(trace, recording));
    if (written && !options.json.empty()) written = write_file(options.json, evaluation::to_json(metrics));
    return written;
}

Result<void> evaluate(const EvaluateOptions& options) {
    const service::Interruption interruption;
    std::optional<ExitWhenInterrupted> reading(interruption);
    if (auto writable = check_outputs({options.cameras, options.terms, options.json}); !writable)
        return writable;
    ProgressLine line;
    line.show("reading " + options.trace, 0, 0);
    const auto match = read_match(options);
    if (!match) return tl::unexpected(match.error());
    const evaluation::Trace& trace = match->frames;
    line.show("reading " + options.map, 0, 0);
    const auto map = open_map(options);
    if (!map) return tl::unexpected(map.error());
    const oracle::Oracle oracle(map->scene, map->point_radius);
    reading.reset();
    const auto recording = make_cameras(options, *match, map->scene, line, interruption.token());
    if (!recording) return tl::unexpected(recording.error());
    const auto explored = [&](std::uint64_t cells) { line.show("judging, cells explored", cells, 0); };
    auto metrics =
        evaluation::measure(map->scene, oracle, trace, recording->cameras, explored, interruption.token());
    if (!metrics) return tl::unexpected(metrics.error());
    if (match->kills)
        metrics->kill_in_view = evaluation::kill_in_view(oracle, map->scene.metres_per_unit, trace,
                                                         recording->cameras, *match->kills);
    line.clear();
    print(options, trace, *metrics, *recording);
    return write_results(options, trace, *metrics, *recording);
}

}  // namespace

void add_evaluate(CLI::App& root, Run& run) {
    auto options = std::make_shared<EvaluateOptions>();
    CLI::App* command =
        root.add_subcommand("evaluate", "Run cameras over a recorded match and judge them against its map.");
    command->add_option("FILE.vfs", options->freespace, "The map's baked freespace; what the tracker sees");
    command->add_option("--map", options->map, "The source map: a file, or archive.pk3:maps/name.bsp")
        ->required();
    command->add_option("--trace", options->trace, "The recorded match, CSV or CSV.gz")->required();
    command->add_option("--events", options->events, "The match's events, CSV or CSV.gz: kills in view");
    command->add_option("--config", options->config,
                        "Configuration that has the profile; default: those that ship");
    command->add_option("--profile", options->profile, "The tracker's profile")->capture_default_str();
    auto* camera =
        command->add_option("--camera", options->camera, "tracker, or a camera to compare with: eye, rigid")
            ->capture_default_str()
            ->check(CLI::IsMember({tracker, "eye", "rigid"}));
    command->add_option("--judge", options->judge, "Judge these cameras (as --cameras writes them) instead")
        ->excludes(camera);
    command
        ->add_option("--output-hz", options->output_hz,
                     "Cameras per second, judged against interpolated poses; default: the trace's frames")
        ->check(CLI::Range(1.0, 1000.0));
    command
        ->add_option("--look-ahead", options->look_ahead,
                     "Seconds of each player's future that the camera knows, as with a delay; 0: causal")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 120.0));
    command->add_option("--solver", options->solver, "paper or planner; default: the profile's")
        ->check(CLI::IsMember({paper, planner}));
    command->add_option("--cameras", options->cameras, "Write the cameras, CSV; - = standard output");
    command->add_option("--terms", options->terms, "Write the tracker's objective terms, CSV");
    command->add_option("--json", options->json, "Write the metrics, JSON; - = standard output");
    command->callback([options, &run] {
        check_usage(*options);
        run = [options] { return exit_code_of(evaluate(*options)); };
    });
}

}  // namespace camdir::app
