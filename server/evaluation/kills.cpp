#include "evaluation/kills.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "base/file.hpp"
#include "evaluation/csv.hpp"
#include "evaluation/picture.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::int64_t kill_span = 250'000'000;  // ns before a kill in which its victim is to be seen

enum KillField { kill_time, kill_kind, kill_killer, kill_victim };

constexpr TextColumn kill_columns[] = {
    {"t_ms", "t_ms"}, {"event", "kind"}, {"player", "actor"}, {"other", "subject"}};

std::optional<Kill> kill_between(std::int64_t time, std::optional<std::uint32_t> killer,
                                 std::optional<std::uint32_t> victim) {
    if (!killer || !victim || *killer == *victim) return std::nullopt;
    return Kill{time, *killer, *victim};
}

// Nothing when the row is no kill of one player by another.
Result<std::optional<Kill>> kill_of(std::span<const std::string_view> row, const Trace& trace) {
    const auto time = time_in(row[kill_time]);
    if (!time) return tl::unexpected(time.error());
    if (row[kill_kind] != "kill") return {};
    const auto killer = player_in(row[kill_killer], kill_columns[kill_killer].name, trace);
    if (!killer) return tl::unexpected(killer.error());
    const auto victim = player_in(row[kill_victim], kill_columns[kill_victim].name, trace);
    if (!victim) return tl::unexpected(victim.error());
    return kill_between(*time, *killer, *victim);
}

// The frames from 0.25 s before the kill to the kill; none when the trace does not hold all of that time.
std::span<const TraceFrame> frames_of(const Kill& kill, const Trace& trace) {
    const std::span<const TraceFrame> frames = trace.frames;
    if (kill.time - kill_span < frames.front().time || kill.time > frames.back().time) return {};
    const auto first = std::ranges::lower_bound(frames, kill.time - kill_span, {}, &TraceFrame::time);
    const auto end = std::ranges::upper_bound(frames, kill.time, {}, &TraceFrame::time);
    return {first, end};
}

class KillJudge {
  public:
    KillJudge(const oracle::Oracle& oracle, double unit, const Trace& trace,
              std::span<const CameraSample> cameras)
        : oracle_(oracle), unit_(unit), trace_(trace), cameras_(cameras) {}

    // Nothing when the kill is not counted.
    [[nodiscard]] std::optional<bool> shows(const Kill& kill) const {
        const auto frames = frames_of(kill, trace_);
        if (frames.empty()) return std::nullopt;
        bool all = true;
        for (const TraceFrame& frame : frames) {
            const std::uint32_t killer = pose_of(trace_, frame, kill.killer);
            const std::uint32_t victim = pose_of(trace_, frame, kill.victim);
            if (killer == absent || victim == absent) return std::nullopt;
            all = all && shows(cameras_[killer], trace_.poses[victim]);
        }
        return all;
    }

  private:
    [[nodiscard]] bool shows(const CameraSample& camera, const TracePose& victim) const {
        return shows(camera, victim.eye) || shows(camera, player_box(victim, unit_).center());
    }
    [[nodiscard]] bool shows(const CameraSample& camera, const Vec3d& point) const {
        return in_picture(camera, point, 1.0) && oracle_.segment_clear(camera.position, point);
    }

    const oracle::Oracle& oracle_;
    double unit_;
    const Trace& trace_;
    std::span<const CameraSample> cameras_;
};

}  // namespace

Result<std::vector<Kill>> parse_kills(std::span<const std::byte> bytes, const std::string& name,
                                      const Trace& trace) {
    std::vector<Kill> kills;
    const auto read = read_text_csv(bytes, name, kill_columns, [&](auto row) -> Result<void> {
        const auto kill = kill_of(row, trace);
        if (!kill) return tl::unexpected(kill.error());
        if (*kill) kills.push_back(**kill);
        return {};
    });
    if (!read) return tl::unexpected(read.error());
    return kills;
}

Result<std::vector<Kill>> read_kills(const std::filesystem::path& path, const Trace& trace) {
    const auto bytes = read_file(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_kills(*bytes, path.string(), trace);
}

Result<std::optional<std::vector<Kill>>> kills_of(const RecordedMatch& match,
                                                  const std::filesystem::path& events) {
    if (!events.empty()) return read_kills(events, match.trace);
    if (!match.events) return std::optional<std::vector<Kill>>();
    std::vector<Kill> kills;
    for (const TraceEvent& event : *match.events) {
        if (event.kind != "kill") continue;
        if (const auto kill = kill_between(event.time, event.actor, event.subject)) kills.push_back(*kill);
    }
    return std::optional(std::move(kills));
}

double kill_in_view(const oracle::Oracle& oracle, double metres_per_unit, const Trace& trace,
                    std::span<const CameraSample> cameras, std::span<const Kill> kills) {
    assert(cameras.size() == trace.poses.size());
    const KillJudge judge(oracle, metres_of_nominal_unit / metres_per_unit, trace, cameras);
    std::size_t counted = 0;
    std::size_t shown = 0;
    for (const Kill& kill : kills) {
        const std::optional<bool> shows = judge.shows(kill);
        counted += shows.has_value();
        shown += shows.value_or(false);
    }
    if (counted == 0) return std::numeric_limits<double>::quiet_NaN();
    return 100.0 * static_cast<double>(shown) / static_cast<double>(counted);
}

}  // namespace camdir::evaluation
