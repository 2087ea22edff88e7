// What `render` draws besides the map and its mesh: ways, points and their key.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "freespace/freespace.hpp"
#include "render/draw.hpp"
#include "render/page.hpp"

namespace camdir::exports {

// Recorded ways to draw. Files may be empty: then nothing is added.
struct Ways {
    std::string trace;                   // a recorded match
    std::string cameras;                 // its cameras
    std::vector<std::uint32_t> players;  // empty = all
    double from = 0.0;                   // seconds since the trace's first frame
    double until = 1e9;
};

// The players' ways and, thinner and darker, those of their cameras; `pixel` is a pixel's width, map units.
[[nodiscard]] Result<void> add_ways(const Ways& ways, float pixel, render::Layers& layers,
                                    std::vector<render::KeyEntry>& key);

void add_spawn_points(const freespace::Freespace& freespace, float pixel, render::Layers& layers,
                      std::vector<render::KeyEntry>& key);

// Points that uniform sampling takes on the map's obstacles, one at least every `d0`; of a cloud its own.
[[nodiscard]] Result<void> add_samples(const scene::Scene& map, double d0, float pixel,
                                       render::Layers& layers, std::vector<render::KeyEntry>& key);

}  // namespace camdir::exports
