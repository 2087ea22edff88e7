#include "app/evaluate_inputs.hpp"

#include <algorithm>
#include <iostream>
#include <map>
#include <set>
#include <span>

#include "app/recorded_match.hpp"
#include "director/clock.hpp"
#include "evaluation/resample.hpp"
#include "freespace/distance.hpp"
#include "maps/source.hpp"
#include "scene/load.hpp"

namespace camdir::app {
namespace {

constexpr std::size_t looked_at = 1000;  // poses of a match, about
constexpr std::size_t fewest_kills = 4;  // that say something of a match
constexpr double dies_within = 0.3;      // s

bool lives_on(const evaluation::Trace& trace, const evaluation::TraceFrame& frame, std::uint32_t player) {
    const std::uint32_t at = evaluation::pose_of(trace, frame, player);
    return at != evaluation::absent && trace.poses[at].alive && !trace.poses[at].discontinuity;
}

// Or is gone, or has jumped: in the first frame that is not before `time`, however late, or in those within
// dies_within of it. Precondition: there is such a frame.
bool dies(const evaluation::Trace& trace, std::uint32_t player, std::int64_t time) {
    auto frame = std::ranges::lower_bound(trace.frames, time, {}, &evaluation::TraceFrame::time);
    do {
        if (!lives_on(trace, *frame, player)) return true;
        ++frame;
    } while (frame != trace.frames.end() && director::seconds_between(time, frame->time) <= dies_within);
    return false;
}

void warn_of_models_without(const std::map<std::uint32_t, std::uint32_t>& places, const std::string& map,
                            const std::string& file, std::span<const evaluation::MoverRow> rows) {
    std::set<std::uint32_t> unknown;
    for (const evaluation::MoverRow& row : rows)
        if (!places.contains(row.model)) unknown.insert(row.model);
    if (unknown.empty()) return;
    std::cerr << "camera-director: warning: " << file << ": " << unknown.size()
              << " of its models are no movers of " << map << " and left out, *" << *unknown.begin()
              << " first\n";
}

}  // namespace

Result<Match> read_match(const EvaluateOptions& options, ProgressLine& line) {
    auto recorded = read_match(options.trace, line);
    if (!recorded) return tl::unexpected(recorded.error());
    Match match;
    auto kills = evaluation::kills_of(*recorded, options.events);
    if (!kills) return tl::unexpected(kills.error());
    match.kills = std::move(*kills);
    if (!options.movers.empty()) {
        auto movers = evaluation::read_movers(options.movers);
        if (!movers) return tl::unexpected(movers.error());
        match.movers = std::move(*movers);
    }
    auto frames = options.output_hz == 0.0 ? Result<evaluation::Trace>(recorded->trace)
                                           : evaluation::resample(recorded->trace, options.output_hz);
    if (!frames) return fail(options.trace + ": " + frames.error().message);
    match.poses = std::move(recorded->trace);
    match.frames = std::move(*frames);
    return match;
}

// The baked file holds the options for reading a mesh or a point cloud.
Result<SourceMap> open_map(const std::string& freespace, const std::string& map) {
    if (freespace.empty()) {
        auto scene = scene::load(map);
        if (!scene) return tl::unexpected(scene.error());
        if (scene->points.empty()) return SourceMap{std::move(*scene), {}};
        return fail(map +
                    ": is a point cloud; name the FILE.vfs too, which says how far its "
                    "surfaces may be from its points");
    }
    auto opened = freespace::Freespace::open(freespace);
    if (!opened) return tl::unexpected(opened.error());
    auto scene = maps::load_source(*opened, map);
    if (!scene) return tl::unexpected(scene.error());
    const double d0 = opened->metadata().d0;
    return SourceMap{std::move(*scene), std::move(*opened), d0};
}

void warn_of_unknown_movers(const std::string& file, std::span<const evaluation::MoverRow> rows,
                            const std::string& map, const std::string& freespace, const SourceMap& opened) {
    warn_of_models_without(evaluation::places_by_model(std::span(opened.scene.movers)), map, file, rows);
    if (opened.freespace && !freespace.empty())
        warn_of_models_without(evaluation::places_by_model(opened.freespace->movers()), freespace, file,
                               rows);
}

void warn_of_another_source(const std::string& freespace, const std::string& map, const SourceMap& opened) {
    if (!opened.freespace || opened.freespace->metadata().source_hash == opened.scene.source_hash) return;
    std::cerr << "camera-director: warning: " << freespace << " was baked from another file than " << map
              << '\n';
}

void warn_of_another_map(const std::string& trace, const evaluation::Trace& poses,
                         const std::string& freespace, const SourceMap& opened) {
    if (!opened.freespace) return;
    // Odd: players often are a power of two.
    const std::size_t stride = poses.poses.size() / looked_at | 1U;
    std::size_t alive = 0;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < poses.poses.size(); i += stride) {
        const evaluation::TracePose& pose = poses.poses[i];
        if (!pose.alive) continue;
        ++alive;
        inside += freespace::distance(*opened.freespace, pose.eye.cast<float>()).covered() ? 1 : 0;
    }
    if (2 * inside >= alive) return;
    std::cerr << "camera-director: warning: " << trace << ": " << inside << " of " << alive
              << " poses that were looked at are in the free space of " << freespace
              << "; expected a match on this map\n";
}

void warn_of_another_match(const std::string& file, std::span<const evaluation::TraceEvent> events,
                           const std::string& trace, const evaluation::Trace& poses) {
    if (events.empty()) {
        std::cerr << "camera-director: warning: " << file << " has no event that is directed by\n";
        return;
    }
    if (std::ranges::all_of(poses.poses, &evaluation::TracePose::alive)) return;
    std::size_t kills = 0;
    std::size_t deaths = 0;
    for (const evaluation::TraceEvent& event : events) {
        if (event.kind != "kill" || !event.subject || event.time < poses.frames.front().time ||
            director::seconds_between(event.time, poses.frames.back().time) < dies_within)
            continue;
        ++kills;
        deaths += dies(poses, *event.subject, event.time) ? 1 : 0;
    }
    if (kills < fewest_kills || 2 * deaths >= kills) return;
    std::cerr << "camera-director: warning: " << file << ": of " << kills << " who are killed " << deaths
              << " die in " << trace << " then; expected the events of this match, by its clock\n";
}

}  // namespace camdir::app
