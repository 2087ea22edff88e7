#include "evaluation/mover_figures.hpp"

#include <cassert>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "evaluation/placed_movers.hpp"

namespace camdir::evaluation {
namespace {

constexpr MoverFigureName mover_names[] = {
    {"mover_frames_inside", "frames", &MoverFigures::frames_inside,
     "Frames in which the camera is in a door, a lift or the like."},
    {"mover_passages", "steps", &MoverFigures::passages,
     "Steps without a cut on which the camera and a mover meet."},
    {"mover_seen_through", "frames", &MoverFigures::seen_through,
     "Frames in which a mover is between the camera and the eye, and the camera does not call it hidden."},
};

// Judges the cameras of one player.
MoverFigures judge_player(std::span<const scene::Mover> movers, const MoverTracks& tracks, const Trace& trace,
                          std::uint32_t player, std::span<const CameraSample> cameras,
                          std::span<const Judgement> judgements, const std::stop_token& stop) {
    MoverFigures figures;
    const auto track = track_of(trace, player);
    PlacedMovers before;
    for (std::size_t frame = 0; frame < track.size() && !stop.stop_requested(); ++frame) {
        const std::uint32_t pose = track[frame];
        if (pose == absent || !judgements[pose].counted) continue;
        const Vec3d& position = cameras[pose].position;
        const Vec3d& eye = trace.poses[pose].eye;
        PlacedMovers now(movers, tracks, trace.frames[frame].time);
        figures.frames_inside += now.hold(position);
        figures.seen_through +=
            (judgements[pose].faults & hidden) == 0 && cameras[pose].claims_sight && now.touch(position, eye);
        if (judgements[pose].judged_step)
            figures.passages += PlacedMovers::meet(before, cameras[track[frame - 1]].position, now, position);
        before = std::move(now);
    }
    return figures;
}

}  // namespace

std::span<const MoverFigureName> mover_figure_names() {
    return mover_names;
}

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
