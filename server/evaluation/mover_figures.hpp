// What a camera did wrong about doors and lifts, judged against the source map's own planes.
#pragma once

#include <cstddef>
#include <span>
#include <stop_token>

#include "evaluation/judgement.hpp"
#include "evaluation/mover_tracks.hpp"

namespace camdir::evaluation {

// All of these should be 0. Numbers, not shares: what happens to a camera at a door lasts for some frames of
// a match.
struct MoverFigures {
    std::size_t frames_inside = 0;  // counted frames with the camera in a mover
    std::size_t passages = 0;       // steps between counted frames, without a cut, that meet a mover
    // Counted frames whose eye the map lets the camera see, and the camera does not call hidden, but a mover
    // is between.
    std::size_t seen_through = 0;

    MoverFigures& operator+=(const MoverFigures& other);
};

// The names by which users know the figures.
struct MoverFigureName {
    const char* name;
    const char* unit;
    std::size_t MoverFigures::*member;
    const char* meaning;
};
[[nodiscard]] std::span<const MoverFigureName> mover_figure_names();

// judgements[i] is of cameras[i], a camera of trace.poses[i]; `tracks` are of `movers`. Players are judged in
// parallel. Fails with ErrorCode::interrupted soon after `stop` is requested.
[[nodiscard]] Result<MoverFigures> judge_movers(std::span<const scene::Mover> movers,
                                                const MoverTracks& tracks, const Trace& trace,
                                                std::span<const CameraSample> cameras,
                                                std::span<const Judgement> judgements,
                                                const std::stop_token& stop);

}  // namespace camdir::evaluation
