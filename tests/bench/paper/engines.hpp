// What each Voronoi engine takes for the paper's samples of a scene.
#pragma once

#include "bench/paper/method.hpp"

namespace camdir::paper {

struct EngineCost {
    std::uint64_t points = 0;
    Cost diagram;  // best of the runs
    Cost faces;    // the diagram and its faces; best of the runs
};

// On the paper's samples of the scene at `d0` (nominal units), one thread.
[[nodiscard]] Result<EngineCost> measure_engine(Engine engine, const scene::Scene& scene, double d0,
                                                int runs);

}  // namespace camdir::paper
