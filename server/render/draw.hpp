// Draws a map and what was made of it by casting rays: no display, no graphics card.
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

// A way through the map: breaks at points that are not finite.
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

// What is in the picture. Pointers may be null: then that layer is left out. They must outlive draw().
struct Layers {
    const scene::Scene* map = nullptr;  // opaque, grey
    float map_point_radius = 1.0F;      // of a map that is a cloud: points without triangles

    const freespace::Freespace* mesh = nullptr;  // V(S), coloured by free distance
    float mesh_opacity = 0.5F;                   // of its triangles; 0 leaves them out
    float roadmap_width = 0.0F;                  // of its edges in freespace, map units; 0 leaves them out
    float free_distance_maximum = 1.0F;          // the end of the colour scale, map units

    std::vector<Path> paths;
    std::vector<Balls> balls;
};

// Rows drawn and rows in all. Called from several threads.
using ProgressSink = std::function<void(std::uint64_t, std::uint64_t)>;

// Deterministic, whatever the number of threads. Fails with ErrorCode::interrupted soon after `stop` is
// requested, and when memory is short.
[[nodiscard]] Result<Picture> draw(const Layers& layers, const View& view, int width, int height,
                                   const ProgressSink& progress = {}, const std::stop_token& stop = {});

}  // namespace camdir::render
