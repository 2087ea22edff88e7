// camera-director direct: makes the programme of a recorded match and judges it beside other directors.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "app/commands.hpp"
#include "app/direct_match.hpp"
#include "app/evaluate_inputs.hpp"
#include "app/progress.hpp"
#include "app/recorded_match.hpp"
#include "base/file.hpp"
#include "base/signals.hpp"
#include "camera/view.hpp"
#include "config/config.hpp"
#include "direction/baselines.hpp"
#include "direction/figures.hpp"
#include "direction/moments.hpp"
#include "direction/programme.hpp"
#include "director/edit.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/recording.hpp"
#include "freespace/visibility.hpp"
#include "oracle/oracle.hpp"
#include "report/programme_page.hpp"

namespace camdir::app {
namespace {

struct DirectOptions {
    std::string freespace;
    std::string map;
    std::string trace;
    std::string events;
    std::string movers;
    std::string config;
    std::string cameras;
    std::string json;
    std::string report;
    double delay = 10.0;
};

struct Inputs {
    evaluation::Trace trace;
    std::vector<evaluation::TraceEvent> events;
    std::vector<evaluation::MoverRow> movers;
    SourceMap map;
    direction::Rules rules;
};

void warn_of_no_events(const std::string& trace) {
    std::cerr
        << "camera-director: warning: " << trace << " holds no events, so that no kill can be foreseen: "
        << (std::filesystem::is_directory(trace)
                ? "the game server published none while it was recorded; others are named with --events\n"
                : "name them with --events\n");
}

Result<Inputs> read_inputs(const DirectOptions& options, ProgressLine& line) {
    auto config = options.config.empty() ? config::parse("{}", "", "") : config::load(options.config);
    if (!config) return tl::unexpected(config.error());
    auto match = read_match(options.trace, line);
    if (!match) return tl::unexpected(match.error());
    line.clear();
    if (auto fits = check_length(match->trace); !fits)
        return fail(options.trace + ": " + fits.error().message);
    if (!options.events.empty()) {
        auto events = evaluation::read_events(options.events, match->trace, directs_by);
        if (!events) return tl::unexpected(events.error());
        warn_of_another_match(options.events, *events, options.trace, match->trace);
        match->events = std::move(*events);
    }
    if (!match->events) warn_of_no_events(options.trace);
    std::vector<evaluation::MoverRow> movers;
    if (!options.movers.empty()) {
        auto rows = evaluation::read_movers(options.movers);
        if (!rows) return tl::unexpected(rows.error());
        movers = std::move(*rows);
    }
    line.show("reading " + options.map, 0, 0);
    auto map = open_map(options.freespace, options.map);
    if (!map) return tl::unexpected(map.error());
    line.clear();
    warn_of_another_source(options.freespace, options.map, *map);
    warn_of_another_map(options.trace, match->trace, options.freespace, *map);
    warn_of_unknown_movers(options.movers, movers, options.map, options.freespace, *map);
    return Inputs{std::move(match->trace),
                  std::move(match->events).value_or(std::vector<evaluation::TraceEvent>()), std::move(movers),
                  std::move(*map), std::move(config->direction)};
}

// The rushes of a match, as the editor sees them through the freespace, and as the judge sees them.
struct Rushes {
    evaluation::CameraPath cameras;               // of the trace's poses
    std::vector<freespace::FixedShot> fixed;      // behind those that follow players
    std::vector<evaluation::CameraSample> still;  // their cameras
    direction::Footage edited;
    direction::Footage scouted;  // as the running director knows them
    direction::Footage judged;
};

Result<Rushes> shoot(const DirectOptions& options, const Inputs& inputs, const RecordedMovers& movers,
                     const ClearLine& exact, double unit, ProgressLine& line, const std::stop_token& stop) {
    const auto show = [&](std::uint64_t done, std::uint64_t total) { line.show("tracking", done, total); };
    auto recording = evaluation::record(*inputs.map.freespace, camera::Profile{}, inputs.trace, movers.rows(),
                                        inputs.trace, options.delay, show, stop);
    if (!recording) return tl::unexpected(recording.error());
    line.show("looking", 0, 0);
    const ClearLine proved = [&](const Vec3d& from, const Vec3d& to) {
        return freespace::sight(*inputs.map.freespace, from.cast<float>(), to.cast<float>()).clear;
    };
    const auto stored = inputs.map.freespace->fixed_shots();
    std::vector<freespace::FixedShot> fixed;
    if (inputs.rules.grammar.fixed_shots) fixed.assign(stored.begin(), stored.end());
    auto edited = footage_of(inputs.trace, movers, recording->cameras, fixed, unit, proved, stop);
    if (!edited) return tl::unexpected(edited.error());
    auto scouted = scouted_footage_of(inputs.trace, movers, *inputs.map.freespace, fixed.size(), unit, stop);
    if (!scouted) return tl::unexpected(scouted.error());
    auto judged = footage_of(inputs.trace, movers, recording->cameras, fixed, unit, exact, stop);
    if (!judged) return tl::unexpected(judged.error());
    std::vector<evaluation::CameraSample> still;
    for (const freespace::FixedShot& shot : fixed)
        still.push_back({shot.position.cast<double>(),
                         camera::orientation_of({shot.yaw, shot.pitch}).cast<double>(), false});
    return Rushes{std::move(recording->cameras), std::move(fixed),  std::move(still), std::move(*edited),
                  std::move(*scouted),           std::move(*judged)};
}

using Judged = report::JudgedProgramme;

// What a running director shows, by cameras that begin with its cuts.
struct Running {
    std::span<const direction::Shot> shots;
    const direction::Footage& judged;
};

// The direction's own figures first, then the running director's, the others' and the bound's.
std::vector<Judged> judge(const Rushes& rushes, std::span<const direction::Event> events,
                          std::span<const direction::Moment> moments, std::span<const direction::Shot> shots,
                          const Running& running, const direction::Rules& rules, double unit, double delay) {
    constexpr std::uint64_t seeds = 64;
    const auto figures_of = [&](const direction::Footage& footage,
                                std::span<const direction::Shot> programme) {
        return direction::judge(footage, events, moments, programme, rules.grammar, unit);
    };
    const auto figures = [&](std::span<const direction::Shot> programme) {
        return figures_of(rushes.judged, programme);
    };
    std::vector<direction::Figures> switches;
    for (std::uint64_t seed = 0; seed < seeds; ++seed)
        switches.push_back(figures(direction::random_switch(rushes.judged, seed)));
    return {{"direction", figures(shots)},
            {"running", figures_of(running.judged, running.shots)},
            {"random", direction::mean_of(switches)},
            {"hltv", figures(direction::hltv(rushes.judged, events, unit, delay))},
            {"quakeworld", figures(direction::quakeworld(rushes.judged, events))},
            {"bound", figures(direction::direct_for_kills(rushes.judged, events, rules, unit))}};
}

// Of the rules that count, those to be shown from their begin on: what goes on for long is not, and a killer
// was to be shown before.
std::vector<direction::Moment> moments_to_begin_with(std::span<const direction::Moment> moments,
                                                     const direction::Rules& rules) {
    using direction::Trigger;
    constexpr std::array others = {Trigger::lead, Trigger::streak, Trigger::flag_run, Trigger::last_alive,
                                   Trigger::killer};
    std::vector<direction::Moment> some;
    std::ranges::copy_if(moments, std::back_inserter(some), [&](const direction::Moment& moment) {
        const direction::Rule& rule = rules.moments[moment.rule];
        return rule.is_on() && std::ranges::find(others, rule.trigger) == others.end();
    });
    return some;
}

nlohmann::ordered_json object_of(const direction::Figures& figures) {
    nlohmann::ordered_json object;
    for (const direction::FigureName& figure : direction::figure_names())
        object[figure.name] = figures.*figure.member;
    return object;
}

std::string to_json(const std::vector<Judged>& judged, std::size_t kills_in_reach) {
    nlohmann::ordered_json json = object_of(judged.front().figures);
    json["kills_bound"] = judged.back().figures.kills_seen;
    json["kills_in_reach"] = kills_in_reach;
    for (std::size_t i = 1; i < judged.size(); ++i)
        json[judged[i].name] = object_of(judged[i].figures);
    return json.dump(2) + "\n";
}

void print_table(const std::vector<Judged>& judged, std::size_t kills_in_reach) {
    std::fprintf(stderr, "%-18s", "");
    for (const Judged& one : judged)
        std::fprintf(stderr, "%12s", one.name.c_str());
    for (const direction::FigureName& figure : direction::figure_names()) {
        std::fprintf(stderr, "\n%-18s", figure.name);
        for (const Judged& one : judged)
            std::fprintf(stderr, "%12.*f", figure.decimals, one.figures.*figure.member);
    }
    std::fprintf(stderr,
                 "\nbound: the most kills that can be seen within the grammar; it seeks nothing else, its "
                 "other figures bound nothing\n%zu kills are in reach of the cameras, whatever the grammar\n",
                 kills_in_reach);
}

std::string reason_text(const direction::Reason& reason, const direction::Rules& rules,
                        const evaluation::Trace& trace) {
    const auto name = [&](direction::Index player) { return std::to_string(trace.players[player]); };
    switch (reason.why) {
        case direction::Reason::Why::opening:
            return "opening";
        case direction::Reason::Why::death:
            return "death of " + name(reason.actor);
        case direction::Reason::Why::hidden:
            return "lost sight of " + name(reason.actor);
        case direction::Reason::Why::length:
            return "length";
        case direction::Reason::Why::moment:
            break;
    }
    std::string text = rules.moments[reason.rule].name;
    if (reason.actor != direction::nobody) text += " " + name(reason.actor);
    if (reason.subject != direction::nobody)
        text += (reason.actor != direction::nobody ? "-" : " ") + name(reason.subject);
    return text;
}

// "fixed camera 2 near spawn point 3: kill 1-0", without a comma for tables; of a shot that follows its
// player the reason alone.
std::string shot_text(const Inputs& inputs, const Rushes& rushes, const direction::Shot& shot) {
    const std::string reason = reason_text(shot.reason, inputs.rules, inputs.trace);
    if (!rushes.edited.is_fixed(shot.rush)) return reason;
    const std::size_t number = shot.rush - inputs.trace.players.size();
    const std::uint32_t spawn_point = rushes.fixed[number].spawn_point;
    const std::string place =
        spawn_point == freespace::none ? "" : " near spawn point " + std::to_string(spawn_point);
    return "fixed camera " + std::to_string(number) + place + ": " + reason;
}

// A row for each frame: the camera on the air, whether it begins a shot or jumps, whom it shows and why.
std::string format_programme(const Inputs& inputs, const Rushes& rushes,
                             std::span<const direction::Shot> shots) {
    std::string text = "t_ms,player,x,y,z,qw,qx,qy,qz,cut,reason\n";
    const evaluation::Trace& trace = inputs.trace;
    std::size_t shot = 0;
    std::optional<std::size_t> shown;
    for (const evaluation::TraceFrame& frame : trace.frames) {
        const direction::Beat beat = beat_at(trace, frame.time);
        while (shot + 1 < shots.size() && beat >= shots[shot].end)
            ++shot;
        const std::size_t rush = shots[shot].rush;
        const direction::Index subject = rushes.judged.take(beat, rush).subject;
        const std::string player = subject == direction::nobody ? "" : std::to_string(trace.players[subject]);
        const bool fixed = rushes.judged.is_fixed(rush);
        const std::uint32_t pose =
            fixed ? evaluation::absent : evaluation::pose_of(trace, frame, trace.players[rush]);
        if (!fixed && pose == evaluation::absent) continue;
        const evaluation::CameraSample& camera =
            fixed ? rushes.still[rush - trace.players.size()] : rushes.cameras[pose];
        std::array<char, 256> row{};
        std::snprintf(row.data(), row.size(), ",%s,%.5f,%.5f,%.5f,%.9f,%.9f,%.9f,%.9f,%d,", player.c_str(),
                      camera.position.x(), camera.position.y(), camera.position.z(), camera.orientation.w(),
                      camera.orientation.x(), camera.orientation.y(), camera.orientation.z(),
                      camera.cut || shown != shot ? 1 : 0);
        shown = shot;
        text += evaluation::format_milliseconds(frame.time) + row.data() +
                shot_text(inputs, rushes, shots[shot]) + '\n';
    }
    return text;
}

std::vector<report::Fact> facts_of(const DirectOptions& options, const Inputs& inputs) {
    std::vector<report::Fact> facts = {
        {"Map", options.map + ", " + inputs.map.scene.kind},
        {"Match", options.trace + ", " + std::to_string(inputs.trace.players.size()) + " players, " +
                      evaluation::format_value(report::duration(inputs.trace), 1) + " s"},
        {"Delay", options.delay == 0.0 ? "none: live" : evaluation::format_value(options.delay, 1) + " s"},
        {"Baked map", options.freespace}};
    if (!inputs.events.empty())
        facts.push_back({"Events", options.events.empty() ? options.trace : options.events});
    if (!options.movers.empty()) facts.push_back({"Movers", options.movers});
    if (!options.config.empty()) facts.push_back({"Rules and lengths of shots", options.config});
    return facts;
}

Result<void> write_report(const DirectOptions& options, const Inputs& inputs, const Rushes& rushes,
                          const std::vector<direction::Shot>& shots, const std::vector<Judged>& judged,
                          const std::vector<direction::Event>& events, std::vector<direction::Moment> moments,
                          ProgressLine& line, const std::stop_token& stop) {
    const direction::Rules& rules = inputs.rules;
    report::ProgrammeSubject subject{{inputs.map.scene, inputs.trace, inputs.map.point_radius},
                                     rushes.cameras,
                                     rushes.still,
                                     "The programme of a match on " + inputs.map.scene.name,
                                     facts_of(options, inputs),
                                     judged,
                                     shots,
                                     {},
                                     rushes.judged,
                                     events,
                                     std::move(moments),
                                     rules};
    for (const direction::Shot& shot : shots)
        subject.reasons.push_back(shot_text(inputs, rushes, shot));
    const auto show = [&](std::uint64_t done, std::uint64_t total) { line.show("drawing", done, total); };
    const auto page = report::to_html(subject, show, stop);
    line.clear();
    if (!page) return tl::unexpected(page.error());
    return write_file(options.report, *page);
}

Result<void> direct(const DirectOptions& options) {
    const Interruption interruption;
    const std::stop_token stop = interruption.token();
    std::optional<ExitWhenInterrupted> reading(interruption);
    if (auto writable = check_outputs(
            {options.cameras, options.json, options.report},
            {options.freespace, options.map, options.trace, options.events, options.movers, options.config});
        !writable)
        return writable;
    ProgressLine line;
    const auto inputs = read_inputs(options, line);
    if (!inputs) return tl::unexpected(inputs.error());
    reading.reset();
    const double unit = metres_of_nominal_unit / inputs->map.scene.metres_per_unit;
    const oracle::Oracle oracle(inputs->map.scene, inputs->map.point_radius);
    const ClearLine exact = [&](const Vec3d& from, const Vec3d& to) {
        return oracle.segment_clear(from, to);
    };
    const RecordedMovers movers(inputs->movers, inputs->map.scene.movers, *inputs->map.freespace,
                                inputs->trace);
    const auto rushes = shoot(options, *inputs, movers, exact, unit, line, stop);
    if (!rushes) return tl::unexpected(rushes.error());
    line.show("editing", 0, 0);
    const direction::Rules& rules = inputs->rules;
    const auto events = events_of(inputs->trace, inputs->events);
    const direction::MayShow may_show =
        out_of_the_way(inputs->trace, movers, *inputs->map.freespace, rushes->fixed, unit, rules.grammar,
                       options.delay, stop);
    const auto begin = std::chrono::steady_clock::now();
    const auto shots = direction::direct(rushes->edited, events, rules, unit, options.delay, stop, may_show);
    if (!shots) return tl::unexpected(shots.error());
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    const auto running = direction::direct(rushes->scouted, events, rules, unit,
                                           director::Edit::foresight_s(options.delay), stop, may_show);
    if (!running) return tl::unexpected(running.error());
    line.show("judging", 0, 0);
    const auto cameras = cameras_of_programme(inputs->trace, movers, *inputs->map.freespace, rushes->judged,
                                              rushes->fixed, *running, options.delay, rushes->cameras, stop);
    const auto shown = footage_of(inputs->trace, movers, cameras, rushes->fixed, unit, exact, stop);
    if (!shown) return tl::unexpected(shown.error());
    std::optional<ExitWhenInterrupted> judging(interruption);
    auto moments = direction::find_moments(rushes->judged, events, rules, unit, 0);
    const std::size_t in_reach = direction::kills_in_reach(rushes->judged, events);
    const auto judged = judge(*rushes, events, moments_to_begin_with(moments, rules), *shots,
                              {*running, *shown}, rules, unit, options.delay);
    judging.reset();
    line.clear();
    print_table(judged, in_reach);
    std::fprintf(stderr, "%.3f ms a decision\n",
                 took.count() * direction::cut_every / static_cast<double>(rushes->edited.beats()));
    if (!options.cameras.empty()) {
        auto written = write_file(options.cameras, format_programme(*inputs, *rushes, *shots));
        if (!written) return written;
    }
    if (!options.json.empty()) {
        auto written = write_file(options.json, to_json(judged, in_reach));
        if (!written) return written;
    }
    if (options.report.empty()) return {};
    return write_report(options, *inputs, *rushes, *shots, judged, events, std::move(moments), line, stop);
}

}  // namespace

void add_direct(CLI::App& root, Run& run) {
    auto options = std::make_shared<DirectOptions>();
    CLI::App* command = root.add_subcommand(
        "direct", "Make the programme of a recorded match, one camera of all players', and judge it.");
    command->add_option("FILE.vfs", options->freespace, "The map's baked freespace")->required();
    command->add_option("--map", options->map, "The source map: a file, or archive.pk3:maps/name.bsp")
        ->required();
    command
        ->add_option("--trace", options->trace,
                     "The recorded match, CSV or .mvd, perhaps .gz, or a recording's folder")
        ->required();
    command->add_option("--events", options->events,
                        "The match's events, CSV or CSV.gz; default: those that TRACE has");
    command->add_option("--movers", options->movers,
                        "Where the match's doors and lifts were, CSV or CSV.gz; default: nothing moves");
    command->add_option("--config", options->config,
                        "Configuration that has the rules and lengths of shots; default: those that ship");
    command->add_option("--delay", options->delay, "Seconds that the audience is behind the match; 0: live")
        ->capture_default_str()
        ->check(number_between(0.0, 120.0));
    command->add_option(
        "--cameras", options->cameras,
        "Write the camera of every frame with its player and reason, CSV; - = standard output");
    command->add_option("--json", options->json, "Write the figures, JSON; - = standard output");
    command->add_option(
        "--report", options->report,
        "Write a page to look at, HTML: figures, a timeline of shots and kills, pictures of the "
        "cuts; - = standard output");
    command->callback([options, &run] {
        if (options->freespace.empty()) throw CLI::RequiredError("FILE.vfs");
        check_one_standard_output(
            {{"--cameras", options->cameras}, {"--json", options->json}, {"--report", options->report}});
        run = [options] { return exit_code_of(direct(*options)); };
    });
}

}  // namespace camdir::app
