// How much memory bakes need, and how much they may take.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace camdir::maps {

// Upper estimate of the memory that a bake of the scene needs, in bytes: 48 MiB, and 1.5 kB for each sample:
// uniform sampling puts at most 1.5 samples on each d0^2 of obstacle surface, one on each vertex or point,
// and the shell has its own. `d0` in map units. Measured on the maps of OpenArena.
[[nodiscard]] std::uint64_t estimate_memory(const scene::Scene& scene, double d0);

// The machine's memory, or the limit of this process's control groups where that is less, without what this
// process holds already; bytes, at least 1.
[[nodiscard]] std::uint64_t available_memory();

}  // namespace camdir::maps
