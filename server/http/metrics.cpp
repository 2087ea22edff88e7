#include "http/metrics.hpp"

#include <limits>
#include <set>
#include <span>
#include <utility>

#include "base/utf8.hpp"

namespace camdir::http {
namespace {

using director::Counter;
using director::Statistics;
using prometheus::MetricFamily;
using prometheus::MetricType;

constexpr const char* prefix = "camera_director_";

MetricFamily family(MetricType type, const std::string& name, const std::string& help) {
    MetricFamily result;
    result.name = prefix + name;
    result.help = help;
    result.type = type;
    return result;
}

MetricFamily counter(const std::string& name, const std::string& help, std::uint64_t value) {
    MetricFamily result = counter_family(name, help);
    add_metric(result, static_cast<double>(value));
    return result;
}

MetricFamily gauge(const std::string& name, const std::string& help, std::uint64_t value) {
    MetricFamily result = gauge_family(name, help);
    add_metric(result, static_cast<double>(value));
    return result;
}

void add_histogram(MetricFamily& family, const director::Durations& durations,
                   std::vector<prometheus::ClientMetric::Label> labels = {}) {
    auto& metric = family.metric.emplace_back();
    metric.label = std::move(labels);
    auto& out = metric.histogram;
    for (std::size_t i = 0; i < durations.buckets.size(); ++i) {
        out.sample_count += durations.buckets[i];
        const bool last = i == director::Durations::bounds_s.size();
        out.bucket.push_back({out.sample_count, last ? std::numeric_limits<double>::infinity()
                                                     : director::Durations::bounds_s[i]});
    }
    out.sample_sum = durations.sum_s;
}

MetricFamily by_reason(const std::string& name, const std::string& help, const Statistics& statistics,
                       std::span<const std::pair<Counter, const char*>> reasons) {
    MetricFamily result = counter_family(name, help);
    for (const auto& [reason, label] : reasons)
        add_metric(result, static_cast<double>(statistics[reason]), {{"reason", label}});
    return result;
}

MetricFamily drops(const Statistics& statistics) {
    static constexpr std::pair<Counter, const char*> reasons[] = {
        {Counter::drop_unknown_match, "unknown_match"},
        {Counter::drop_old_epoch, "old_epoch"},
        {Counter::drop_early_epoch, "early_epoch"},
        {Counter::drop_old_frame, "old_frame"},
        {Counter::drop_superseded, "superseded"},
        {Counter::drop_burst, "burst"},
        {Counter::drop_paced, "paced"},
        {Counter::drop_rate, "rate"},
        {Counter::drop_waiting, "no_map"},
        {Counter::drop_players, "players"},
        {Counter::drop_events, "events"},
        {Counter::drop_messages, "control"},
        {Counter::drop_delay, "delay_refused"}};
    return by_reason("dropped_total", "Input that was dropped, by reason.", statistics, reasons);
}

MetricFamily refused_matches(const Statistics& statistics) {
    static constexpr std::pair<Counter, const char*> reasons[] = {{Counter::refused_matches, "matches"},
                                                                  {Counter::refused_matches_delay, "delay"},
                                                                  {Counter::refused_matches_map, "map"}};
    return by_reason("refused_matches_total", "Matches refused, by reason.", statistics, reasons);
}

MetricFamily refused_requests(const Statistics& statistics) {
    static constexpr std::pair<Counter, const char*> reasons[] = {{Counter::refused_invalid, "invalid"},
                                                                  {Counter::refused_match, "match"},
                                                                  {Counter::refused_observers, "observers"},
                                                                  {Counter::refused_shots, "shots"},
                                                                  {Counter::refused_no_match, "no_match"}};
    return by_reason("refused_requests_total", "Requests refused, by reason.", statistics, reasons);
}

MetricFamily stages(const Statistics& statistics) {
    MetricFamily result = family(MetricType::Histogram, "stage_seconds",
                                 "The parts of latency_seconds: waiting for the match's turn, computing the "
                                 "cameras, writing them.");
    add_histogram(result, statistics.waiting, {{"stage", "waiting"}});
    add_histogram(result, statistics.computing, {{"stage", "computing"}});
    add_histogram(result, statistics.writing, {{"stage", "writing"}});
    return result;
}

}  // namespace

MetricFamily counter_family(const std::string& name, const std::string& help) {
    return family(MetricType::Counter, name, help);
}

MetricFamily gauge_family(const std::string& name, const std::string& help) {
    return family(MetricType::Gauge, name, help);
}

MetricFamily histogram(const std::string& name, const std::string& help,
                       const director::Durations& durations) {
    MetricFamily result = family(MetricType::Histogram, name, help);
    add_histogram(result, durations);
    return result;
}

void add_metric(MetricFamily& family, double value, std::vector<prometheus::ClientMetric::Label> labels) {
    auto& metric = family.metric.emplace_back();
    metric.label = std::move(labels);
    if (family.type == MetricType::Counter)
        metric.counter.value = value;
    else
        metric.gauge.value = value;
}

std::vector<MetricFamily> director_metrics(const Statistics& s) {
    return {
        counter("match_infos_total", "MatchInfo samples received.", s[Counter::match_infos]),
        counter("pose_frames_total", "Pose frames of running matches.", s[Counter::pose_frames]),
        counter("events_total", "Match events.", s[Counter::events]),
        counter("requests_total", "Observer requests, new or changed.", s[Counter::requests]),
        counter("camera_frames_total", "Camera frames published.", s[Counter::camera_frames]),
        counter("cameras_total", "Cameras in them.", s[Counter::cameras]),
        counter("cuts_total", "Declared jumps of cameras.", s[Counter::cuts]),
        counter("searches_total", "Searches of a camera for its lost player.", s[Counter::searches]),
        counter("silences_total", "Matches that became silent.", s[Counter::silences]),
        refused_matches(s),
        refused_requests(s),
        counter("map_hash_mismatches_total", "Matches whose map file differs from the baked one.",
                s[Counter::map_hash_mismatches]),
        counter("scale_mismatches_total", "Matches whose metres_per_unit differs from the baked map's.",
                s[Counter::scale_mismatches]),
        counter("mover_frames_total", "Frames in which a match's doors and lifts were elsewhere than before.",
                s[Counter::mover_frames]),
        counter("unknown_movers_total", "Movers whose model the match's map does not have.",
                s[Counter::unknown_movers]),
        drops(s),
        gauge("matches", "Matches that have a game server.", s.matches),
        gauge("silent_matches", "Matches that are silent.", s.silent_matches),
        gauge("observers", "Observers.", s.observers),
        gauge("shots", "Shots, each with a camera.", s.shots),
        gauge("frames_per_camera",
              "Of so many pose frames of a match one becomes cameras; more than 1: the machine is too "
              "slow.",
              s.frames_per_camera),
        gauge("delayed_bytes", "Memory of what waits for its delay.", s.delayed_bytes),
        histogram("step_seconds",
                  "Duration of one tracker step of one shot, also of steps made ahead in vain.", s.step),
        histogram(
            "latency_seconds",
            "Time from receiving a pose frame, or from when it is due after the delay, to publishing its "
            "cameras.",
            s.latency),
        stages(s)};
}

std::vector<MetricFamily> match_metrics(const std::vector<director::MatchStatistics>& matches) {
    MetricFamily frames = counter_family("match_pose_frames_total", "Pose frames of the match.");
    MetricFamily superseded = counter_family(
        "match_superseded_total", "Pose frames of the match that a newer one replaced unprocessed.");
    MetricFamily cameras = counter_family("match_cameras_total", "Cameras of the match.");
    MetricFamily observers = gauge_family("match_observers", "Observers of the match.");
    MetricFamily latency =
        family(MetricType::Histogram, "match_latency_seconds", "As latency_seconds, of the match alone.");
    std::set<std::string> ids;
    for (const auto& [match_id, s] : matches) {
        const auto [id, is_new] = ids.insert(to_utf8(match_id));
        if (!is_new) continue;
        const std::vector<prometheus::ClientMetric::Label> label = {{"match", *id}};
        add_metric(frames, static_cast<double>(s[Counter::pose_frames]), label);
        add_metric(superseded, static_cast<double>(s[Counter::drop_superseded]), label);
        add_metric(cameras, static_cast<double>(s[Counter::cameras]), label);
        add_metric(observers, static_cast<double>(s.observers), label);
        add_histogram(latency, s.latency, label);
    }
    return {frames, superseded, cameras, observers, latency};
}

std::vector<MetricFamily> map_metrics(const std::map<std::string, director::MapEntry>& maps) {
    MetricFamily loaded = gauge_family("map_loaded", "1 when the map can be used.");
    MetricFamily failed = gauge_family(
        "map_failed", "1 when the map could not be loaded or baked; one that was loaded before is used.");
    MetricFamily bake =
        gauge_family("map_bake_seconds", "Duration of the map's bake by this process, 0 without one.");
    for (const auto& [name, entry] : maps) {
        add_metric(loaded, entry.freespace ? 1.0 : 0.0, {{"map", name}});
        add_metric(failed, entry.state == director::LoadState::failed ? 1.0 : 0.0, {{"map", name}});
        add_metric(bake, entry.bake_seconds, {{"map", name}});
    }
    return {loaded, failed, bake};
}

std::vector<MetricFamily> config_metrics(bool refused, std::size_t keys_for_restart) {
    MetricFamily file = gauge_family(
        "config_refused",
        "1 when the configuration file was refused at the last reload: so it would be at a restart.");
    MetricFamily keys = gauge_family("config_keys_for_restart",
                                     "Keys of the configuration file that take effect only after a restart.");
    add_metric(file, refused ? 1.0 : 0.0);
    add_metric(keys, static_cast<double>(keys_for_restart));
    return {file, keys};
}

std::vector<MetricFamily> live_metrics(const live::RelayStatistics& statistics) {
    MetricFamily viewers = gauge_family("live_viewers", "Browsers that watch a match.");
    MetricFamily frames = counter_family("live_frames_total", "Frames put before viewers.");
    MetricFamily dropped =
        counter_family("live_dropped_frames_total", "Of these, those that a viewer was too slow for.");
    MetricFamily lost = counter_family("live_lost_viewers_total",
                                       "Viewers whose connection was closed because they were too slow.");
    add_metric(viewers, static_cast<double>(statistics.viewers));
    add_metric(frames, static_cast<double>(statistics.frames));
    add_metric(dropped, static_cast<double>(statistics.dropped_frames));
    add_metric(lost, static_cast<double>(statistics.lost_viewers));
    return {viewers, frames, dropped, lost};
}

MetricFamily bound_metrics(const BoundCounters& bounds_reached) {
    MetricFamily result = counter_family(
        "http_bounds_total", "HTTP connections closed and requests refused at a bound, by its name.");
    for (std::size_t i = 0; i < bound_names.size(); ++i)
        add_metric(result, static_cast<double>(bounds_reached[static_cast<Bound>(i)]),
                   {{"bound", bound_names[i]}});
    return result;
}

}  // namespace camdir::http
