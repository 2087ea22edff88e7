// The map and the players as a camera sees them in one frame of a match.
#pragma once

#include <stop_token>
#include <string>

#include "base/error.hpp"
#include "evaluation/camera_path.hpp"
#include "render/draw.hpp"
#include "scene/scene.hpp"

namespace camdir::report {

inline constexpr int picture_width = 320, picture_height = 180;

// 90 degrees across.
[[nodiscard]] render::View view_of(const evaluation::CameraSample& camera);

// What pictures of a match are drawn from; `point_radius`: of the obstacles in a cloud. The scene and the
// trace must outlive it.
struct Stage {
    const scene::Scene& scene;
    const evaluation::Trace& trace;
    double point_radius = 0.0;
};

// An `image` element for an SVG of 320 x 180: the living players as simple figures with a dark nose. Fails as
// render::draw.
[[nodiscard]] Result<std::string> frame_picture(const Stage& stage, std::size_t frame,
                                                const evaluation::CameraSample& camera,
                                                const std::stop_token& stop);

}  // namespace camdir::report
