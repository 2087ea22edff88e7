// The two Voronoi engines on the same samples.
#pragma once

#include <vector>

#include "base/error.hpp"
#include "bench/paper/stopwatch.hpp"
#include "scene/scene.hpp"

namespace camdir::paper {

struct EngineCost {
    Cost diagram;  // best of the runs
    Cost faces;    // the diagram and its faces; best of the runs
};

struct Engines {
    std::uint64_t points = 0;
    EngineCost qhull;
    EngineCost cgal;
};

// On the paper's samples of the scene at `d0` (nominal units), one thread.
[[nodiscard]] Result<Engines> compare_engines(const scene::Scene& scene, double d0, int runs);

}  // namespace camdir::paper
