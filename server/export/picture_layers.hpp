// Layers of a picture besides the map and its mesh: recorded tracks, points and their legend.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "freespace/freespace.hpp"
#include "render/draw.hpp"
#include "render/page.hpp"

namespace camdir::exports {

// Recorded tracks to draw. Empty file names add nothing.
struct Tracks {
    std::string trace;                   // a recorded match
    std::string cameras;                 // its cameras
    std::vector<std::uint32_t> players;  // empty = all
    double from = 0.0;                   // seconds since the trace's first frame
    double until = 1e9;
};

// The players' tracks and, thinner and darker, those of their cameras. `pixel` is the width of a pixel in map
// units.
[[nodiscard]] Result<void> add_tracks(const Tracks& tracks, float pixel, render::Layers& layers,
                                      std::vector<render::KeyEntry>& key);

void add_spawn_points(const freespace::Freespace& freespace, float pixel, render::Layers& layers,
                      std::vector<render::KeyEntry>& key);

// The points of a cloud, or points that uniform sampling puts on the obstacles, at least one every `d0`.
[[nodiscard]] Result<void> add_samples(const scene::Scene& map, double d0, float pixel,
                                       render::Layers& layers, std::vector<render::KeyEntry>& key);

}  // namespace camdir::exports
