#include "app/evaluate_group.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <span>
#include <utility>

#include "app/evaluate_cameras.hpp"
#include "app/recorded_movers.hpp"
#include "base/file.hpp"
#include "evaluation/group_figures.hpp"
#include "evaluation/group_recording.hpp"
#include "evaluation/statistics.hpp"
#include "freespace/lookouts.hpp"
#include "freespace/visibility.hpp"
#include "oracle/oracle.hpp"

namespace camdir::app {
namespace {

Result<void> check_members(const EvaluateOptions& options, const Match& match) {
    for (const std::uint32_t member : options.group)
        if (!std::ranges::binary_search(match.frames.players, member))
            return fail("--group: " + options.trace + " has no player " + std::to_string(member));
    return {};
}

evaluation::CameraPath for_every_player(const evaluation::Trace& trace,
                                        std::span<const evaluation::CameraSample> cameras) {
    evaluation::CameraPath path;
    for (std::size_t f = 0; f < trace.frames.size(); ++f)
        path.insert(path.end(), trace.frames[f].pose_count, cameras[f]);
    return path;
}

}  // namespace

Result<void> evaluate_group(const EvaluateOptions& options, const Match& match, const SourceMap& map,
                            ProgressLine& line, const std::stop_token& stop) {
    if (auto checked = check_members(options, match); !checked) return checked;
    const auto profile = choose_profile(options);
    if (!profile) return tl::unexpected(profile.error());
    line.show("tracking the group", 0, 0);
    const RecordedMovers movers(
        match.movers ? std::span(std::as_const(*match.movers)) : std::span<const evaluation::MoverRow>(),
        map.scene.movers, *map.freespace, match.poses);
    const auto made = evaluation::record_group(*map.freespace, *profile, match.poses, movers.rows(),
                                               match.frames, options.group, options.look_ahead, stop);
    if (!made) return tl::unexpected(made.error());
    line.show("judging", 0, 0);
    const oracle::Oracle oracle(map.scene, map.point_radius);
    evaluation::MoversAt movers_at;
    if (match.movers) movers_at = [&](std::int64_t time) { return movers.exact_at(time); };
    const auto proves = [&](const Vec3f& from, const Vec3f& to) {
        return freespace::sight(*map.freespace, from, to).clear;
    };
    const auto figures =
        evaluation::judge_group(oracle, map.scene.metres_per_unit, match.frames, options.group, made->cameras,
                                map.freespace->lookouts().positions(), proves, movers_at, stop);
    line.clear();
    if (!figures) return tl::unexpected(figures.error());
    std::cerr << evaluation::to_table(*figures) << "cost                 median "
              << std::llround(evaluation::percentile(made->step_nanoseconds, 0.5)) << "  p99 "
              << std::llround(evaluation::percentile(made->step_nanoseconds, 0.99)) << "  mean "
              << std::llround(evaluation::mean(made->step_nanoseconds)) << " ns of CPU time an update\n";
    if (!options.cameras.empty()) {
        const auto path = for_every_player(match.frames, made->cameras);
        auto written = write_file(options.cameras, evaluation::format_cameras(match.frames, path));
        if (!written) return written;
    }
    if (options.json.empty()) return {};
    return write_file(options.json, evaluation::to_json(*figures));
}

}  // namespace camdir::app
