#include "bake/clearance.hpp"

namespace camdir::bake {

Result<std::vector<double>> clearances(const MedialMesh& mesh, const Obstacles& obstacles, Stage& stage) {
    std::vector<double> result(mesh.vertices.size());
    const bool done = stage.for_each(result.size(), [&](std::uint64_t i) {
        result[i] = obstacles.distance(mesh.position(static_cast<std::uint32_t>(i)));
    });
    if (!done) return stage.interrupted();
    return result;
}

}  // namespace camdir::bake
