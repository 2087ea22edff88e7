// Draws a map and its baked mesh by ray casting, without a display or graphics card.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "freespace/freespace.hpp"
#include "render/picture.hpp"
#include "render/view.hpp"
#include "scene/scene.hpp"

namespace camdir::render {

// A track through the map; points that are not finite interrupt it.
struct Path {
    std::vector<Vec3f> points;
    Colour colour;
    float width = 0.0F;  // map units
};

struct Balls {
    std::vector<Vec3f> centres;
    Colour colour;
    float radius = 0.0F;  // map units
};

// The contents of a picture. A null pointer omits its layer; the others must outlive draw().
struct Layers {
    const scene::Scene* map = nullptr;  // opaque, grey
    float map_point_radius = 1.0F;      // of a map that is a cloud: points without triangles

    const freespace::Freespace* mesh = nullptr;  // V(S), coloured by free distance
    float mesh_opacity = 0.5F;                   // of its triangles; 0: not drawn
    float roadmap_width = 0.0F;                  // of its edges in freespace, map units; 0: not drawn
    float free_distance_maximum = 1.0F;          // the end of the colour scale, map units

    std::vector<Path> paths;
    std::vector<Balls> balls;
};

// Rows drawn and total rows. Called from several threads.
using ProgressSink = std::function<void(std::uint64_t, std::uint64_t)>;

// The result does not depend on the number of threads. Fails with ErrorCode::interrupted soon after `stop` is
// requested, and when memory is short.
[[nodiscard]] Result<Picture> draw(const Layers& layers, const View& view, int width, int height,
                                   const ProgressSink& progress = {}, const std::stop_token& stop = {});

}  // namespace camdir::render
