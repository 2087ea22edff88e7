// Baking: Scene -> VFS-rep. The paper's section 4.
#pragma once

#include <stop_token>
#include <vector>

#include "bake/parameters.hpp"
#include "bake/progress.hpp"
#include "base/error.hpp"
#include "freespace/freespace.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

struct Baked {
    freespace::Contents contents;
    std::vector<StageReport> stages;
};

// Runs all stages. Calls `finished` after each, and `expected` as soon as it is known what the bake is going
// to take, both on the calling thread. May be called by several threads at once. Fails with
// ErrorCode::interrupted soon after `stop` is requested, and with `failed` when a parameter is out of its
// range, when the scene has no obstacles, no spawn point in free space, or too many samples for memory, and
// when a slab of the finished mesh is found to reach into an obstacle.
[[nodiscard]] Result<Baked> bake(const scene::Scene& scene, const Parameters& parameters,
                                 const ProgressSink& progress, std::stop_token stop,
                                 const ReportSink& finished = {}, const ForecastSink& expected = {});

}  // namespace camdir::bake
