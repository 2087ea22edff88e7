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

// Runs all stages; tells `finished`, on the calling thread, about each when it is done. May be called by
// several threads at once. Fails with ErrorCode::interrupted soon after `stop` is requested, and with
// `failed` when a parameter is out of its range, or when the scene has no obstacles, no spawn point in free
// space, or too many samples for memory.
[[nodiscard]] Result<Baked> bake(const scene::Scene& scene, const Parameters& parameters,
                                 const ProgressSink& progress, std::stop_token stop,
                                 const ReportSink& finished = {});

}  // namespace camdir::bake
