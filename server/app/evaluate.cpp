// camera-director evaluate: measures the cameras of a recorded match against its map.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>
#include <set>
#include <span>

#include "app/commands.hpp"
#include "app/evaluate_cameras.hpp"
#include "app/evaluate_group.hpp"
#include "app/evaluate_inputs.hpp"
#include "app/progress.hpp"
#include "base/file.hpp"
#include "base/signals.hpp"
#include "camera/group/members.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/judgement.hpp"
#include "evaluation/kills.hpp"
#include "evaluation/metrics.hpp"
#include "evaluation/statistics.hpp"
#include "oracle/oracle.hpp"
#include "report/page.hpp"

namespace camdir::app {
namespace {

void check_usage(const EvaluateOptions& options) {
    if (options.tracks() && options.freespace.empty())
        throw CLI::RequiredError("FILE.vfs, or --camera with another camera than the tracker, or --judge");
    if (!options.tracks() && (!options.config.empty() || options.profile != "default"))
        throw CLI::ValidationError("--config and --profile", "only the tracker has a profile");
    if (!options.tracks() && (!options.solver.empty() || options.look_ahead > 0.0))
        throw CLI::ValidationError("--solver and --look-ahead", "only the tracker has a solver");
    if (!options.tracks() && !options.terms.empty())
        throw CLI::ValidationError("--terms", "only the tracker has an objective");
    if (!options.group.empty() && (!options.tracks() || !options.solver.empty()))
        throw CLI::ValidationError("--group", "is a shot of its own: neither --camera, --judge nor --solver");
    if (!options.group.empty() && !(options.terms + options.report + options.events).empty())
        throw CLI::ValidationError("--group", "has neither --terms, --report nor --events");
    if (!options.group.empty() && (options.group.size() < 2 || options.group.size() > camera::max_members))
        throw CLI::ValidationError("--group", "takes two to four players");
    if (std::set(options.group.begin(), options.group.end()).size() != options.group.size())
        throw CLI::ValidationError("--group", "names a player twice");
    check_one_standard_output({{"--cameras", options.cameras},
                               {"--terms", options.terms},
                               {"--json", options.json},
                               {"--report", options.report}});
}

// Why nearly all figures are "-", where they are.
void tell_of_nothing_judged(std::span<const evaluation::Judgement> judgements) {
    if (std::ranges::any_of(judgements, &evaluation::Judgement::counted)) return;
    std::cerr << "no frame is judged, hence the figures without a value: that takes a player who has been "
                 "alive for more than half a second since the first pose, a respawn or a teleport\n";
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

// Judges cameras of one match.
class Judge {
  public:
    Judge(const Match& match, const SourceMap& map)
        : match_(match), map_(map), oracle_(map.scene, map.point_radius) {
        if (match.movers) mover_tracks_.emplace(*match.movers, map.scene.movers, match.poses);
    }

    // Before the first camera.
    Result<void> explore(ProgressLine& line, const std::stop_token& stop) {
        const auto show = [&](std::uint64_t cells) { line.show("judging, cells explored", cells, 0); };
        auto explored = oracle::Reachability::explore(oracle_, map_.scene, show, stop);
        if (!explored) return tl::unexpected(explored.error());
        reachability_ = std::move(*explored);
        return {};
    }

    [[nodiscard]] Result<report::JudgedCamera> judge(const NamedRecording& made,
                                                     const std::stop_token& stop) const {
        const evaluation::CameraPath& cameras = made.recording.cameras;
        auto judgements =
            evaluation::judge(oracle_, *reachability_, evaluation::Thresholds(map_.scene.metres_per_unit),
                              match_.frames, cameras, stop);
        if (!judgements) return tl::unexpected(judgements.error());
        evaluation::Metrics metrics = evaluation::summarise(*judgements);
        if (match_.kills)
            metrics.kill_in_view = evaluation::kill_in_view(oracle_, map_.scene.metres_per_unit,
                                                            match_.frames, cameras, *match_.kills);
        if (mover_tracks_) {
            const auto figures = evaluation::judge_movers(map_.scene.movers, *mover_tracks_, match_.frames,
                                                          cameras, *judgements, stop);
            if (!figures) return tl::unexpected(figures.error());
            metrics.movers = *figures;
        }
        return report::JudgedCamera{made.name, cameras, std::move(*judgements), metrics};
    }

  private:
    const Match& match_;
    const SourceMap& map_;
    oracle::Oracle oracle_;
    std::optional<evaluation::MoverTracks> mover_tracks_;
    std::optional<oracle::Reachability> reachability_;
};

std::string per_second(const evaluation::Trace& trace) {
    const double rate = static_cast<double>(trace.frames.size() - 1) / report::duration(trace);
    return evaluation::format_value(rate, 1) + " a second";
}

std::vector<report::Fact> facts_of(const EvaluateOptions& options, const Match& match, const SourceMap& map) {
    std::vector<report::Fact> facts = {
        {"Map", options.map + ", " + map.scene.kind},
        {"Match", options.trace + ", " + std::to_string(match.frames.players.size()) + " players, " +
                      evaluation::format_value(report::duration(match.frames), 1) + " s"},
        {"Rates", "poses " + per_second(match.poses) + ", cameras " + per_second(match.frames)},
    };
    if (match.kills) facts.push_back({"Events", options.events.empty() ? options.trace : options.events});
    if (match.movers) facts.push_back({"Movers", options.movers});
    if (!options.judge.empty()) facts.push_back({"Cameras", options.judge});
    if (!options.tracks()) return facts;
    facts.push_back(
        {"Profile", options.profile + (options.config.empty() ? ", as shipped" : " of " + options.config)});
    facts.push_back({"Look-ahead", options.look_ahead == 0.0
                                       ? "none: the camera knows the past only"
                                       : evaluation::format_value(options.look_ahead, 2) + " s"});
    facts.push_back({"Baked map", options.freespace});
    return facts;
}

Result<void> write_report(const EvaluateOptions& options, const Match& match, const SourceMap& map,
                          const Judge& judge, report::JudgedCamera own, ProgressLine& line,
                          const std::stop_token& stop) {
    report::Subject subject{map.scene,
                            match.frames,
                            map.point_radius,
                            options.freespace,
                            options.trace,
                            options.judge,
                            facts_of(options, match, map),
                            {}};
    if (options.judge.empty() && options.cameras != "-") subject.cameras_file = options.cameras;
    subject.cameras.push_back(std::move(own));
    const auto others = make_compared_cameras(options, match, map, line, stop);
    if (!others) return tl::unexpected(others.error());
    for (const NamedRecording& other : *others) {
        line.show("judging " + other.name, 0, 0);
        auto judged = judge.judge(other, stop);
        if (!judged) return tl::unexpected(judged.error());
        subject.cameras.push_back(std::move(*judged));
    }
    const auto show = [&](std::uint64_t done, std::uint64_t total) { line.show("drawing", done, total); };
    const auto page = report::to_html(subject, show, stop);
    line.clear();
    if (!page) return tl::unexpected(page.error());
    return write_file(options.report, *page);
}

Result<void> evaluate(const EvaluateOptions& options) {
    const Interruption interruption;
    const std::stop_token stop = interruption.token();
    std::optional<ExitWhenInterrupted> reading(interruption);
    if (auto writable = check_outputs({options.cameras, options.terms, options.json, options.report},
                                      {options.freespace, options.map, options.trace, options.events,
                                       options.movers, options.config, options.judge});
        !writable)
        return writable;
    ProgressLine line;
    const auto match = read_match(options, line);
    if (!match) return tl::unexpected(match.error());
    line.show("reading " + options.map, 0, 0);
    const auto map = open_map(options.freespace, options.map);
    if (!map) return tl::unexpected(map.error());
    line.clear();
    warn_of_another_source(options.freespace, options.map, *map);
    warn_of_another_map(options.trace, match->poses, options.freespace, *map);
    if (match->movers)
        warn_of_unknown_movers(options.movers, *match->movers, options.map,
                               options.tracks() ? options.freespace : "", *map);
    if (!options.group.empty()) {
        reading.reset();
        return evaluate_group(options, *match, *map, line, stop);
    }
    Judge judge(*match, *map);
    reading.reset();
    const auto made = make_cameras(options, *match, *map, line, stop);
    if (!made) return tl::unexpected(made.error());
    if (auto explored = judge.explore(line, stop); !explored) return explored;
    auto judged = judge.judge(*made, stop);
    if (!judged) return tl::unexpected(judged.error());
    line.clear();
    print(options, match->frames, judged->metrics, made->recording);
    tell_of_nothing_judged(judged->judgements);
    auto written = write_results(options, match->frames, judged->metrics, made->recording);
    if (!written || options.report.empty()) return written;
    return write_report(options, *match, *map, judge, std::move(*judged), line, stop);
}

}  // namespace

void add_evaluate(CLI::App& root, Run& run) {
    auto options = std::make_shared<EvaluateOptions>();
    CLI::App* command =
        root.add_subcommand("evaluate", "Run cameras over a recorded match and judge them against its map.");
    command->add_option("FILE.vfs", options->freespace, "The map's baked freespace; what the tracker sees");
    command->add_option("--map", options->map, "The source map: a file, or archive.pk3:maps/name.bsp")
        ->required();
    command
        ->add_option("--trace", options->trace,
                     "The recorded match, CSV or .mvd, perhaps .gz, or a recording's folder")
        ->required();
    command->add_option("--events", options->events,
                        "The match's events, CSV or CSV.gz: kills in view; default: those that TRACE has");
    command->add_option("--movers", options->movers,
                        "Where the match's doors and lifts were, CSV or CSV.gz: the tracker knows them; "
                        "counts cameras in them, through them, and what they hide");
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
        ->check(number_between(1.0, 1000.0));
    command
        ->add_option("--look-ahead", options->look_ahead,
                     "Seconds of each player's future that the camera knows, as with a delay; 0: causal")
        ->capture_default_str()
        ->check(number_between(0.0, 120.0));
    command->add_option("--solver", options->solver, "paper or planner; default: the profile's")
        ->check(CLI::IsMember({paper, planner}));
    command
        ->add_option("--group", options->group,
                     "One camera of these two to four players together, those who matter most first: 0,3")
        ->delimiter(',');
    command->add_option("--cameras", options->cameras, "Write the cameras, CSV; - = standard output");
    command->add_option("--terms", options->terms, "Write the tracker's objective terms, CSV");
    command->add_option("--json", options->json, "Write the metrics, JSON; - = standard output");
    command->add_option(
        "--report", options->report,
        "Write a page to look at, HTML: figures beside other cameras, film strips of the worst "
        "moments, floor plan, series over time; - = standard output");
    command->callback([options, &run] {
        check_usage(*options);
        run = [options] { return exit_code_of(evaluate(*options)); };
    });
}

}  // namespace camdir::app
