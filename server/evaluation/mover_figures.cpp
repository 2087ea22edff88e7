#include "evaluation/mover_figures.hpp"

#include <cassert>
#include <optional>
#include <vector>

#include "base/parallel.hpp"

namespace camdir::evaluation {
namespace {

using Placements = std::vector<std::optional<oracle::Placement>>;  // by mover

Placements placements_at(const MoverTracks& tracks, std::size_t movers, std::int64_t time) {
    Placements placements(movers);
    for (std::size_t i = 0; i < movers; ++i)
        placements[i] = tracks.at(i, time);
    return placements;
}

// A mover meets the point that goes from one place to the other meanwhile.
bool meets(std::span<const scene::Mover> movers, const Placements& before, const Vec3d& from,
           const Placements& after, const Vec3d& to) {
    for (std::size_t i = 0; i < movers.size(); ++i)
        if (before[i] && after[i] && oracle::touches(movers[i], before[i]->local(from), after[i]->local(to)))
            return true;
    return false;
}

// Judges the cameras of one player.
MoverFigures judge_player(std::span<const scene::Mover> movers, const MoverTracks& tracks, const Trace& trace,
                          std::uint32_t player, std::span<const CameraSample> cameras,
                          std::span<const Judgement> judgements, const std::stop_token& stop) {
    MoverFigures figures;
    const auto track = track_of(trace, player);
    Placements before;
    for (std::size_t frame = 0; frame < track.size() && !stop.stop_requested(); ++frame) {
        const std::uint32_t pose = track[frame];
        if (pose == absent || !judgements[pose].counted) continue;
        const Vec3d& position = cameras[pose].position;
        const Vec3d& eye = trace.poses[pose].eye;
        Placements now = placements_at(tracks, movers.size(), trace.frames[frame].time);
        figures.frames_inside += meets(movers, now, position, now, position);
        figures.seen_through += (judgements[pose].faults & hidden) == 0 && cameras[pose].claims_sight &&
                                meets(movers, now, position, now, eye);
        if (judgements[pose].judged_step)
            figures.passages += meets(movers, before, cameras[track[frame - 1]].position, now, position);
        before = std::move(now);
    }
    return figures;
}

}  // namespace

MoverFigures& MoverFigures::operator+=(const MoverFigures& other) {
    frames_inside += other.frames_inside;
    passages += other.passages;
    seen_through += other.seen_through;
    return *this;
}

Result<MoverFigures> judge_movers(std::span<const scene::Mover> movers, const MoverTracks& tracks,
                                  const Trace& trace, std::span<const CameraSample> cameras,
                                  std::span<const Judgement> judgements, const std::stop_token& stop) {
    assert(cameras.size() == trace.poses.size() && judgements.size() == trace.poses.size());
    std::vector<MoverFigures> of_players(trace.players.size());
    parallel_for(std::size_t{0}, trace.players.size(), [&](std::size_t i) {
        of_players[i] = judge_player(movers, tracks, trace, trace.players[i], cameras, judgements, stop);
    });
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    MoverFigures figures;
    for (const MoverFigures& player : of_players)
        figures += player;
    return figures;
}

}  // namespace camdir::evaluation
