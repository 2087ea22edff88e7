// The movers of a scene become the shapes that a MAP.vfs holds.
#pragma once

#include <vector>

#include "bake/stage.hpp"
#include "freespace/mover_shape.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// In the scene's order. Beside the half spaces of its faces a hull has those of its box, and one at every
// edge that the faces turn around by more than 45 degrees, as long as it may have more: outside, the largest
// distance to a half space is then within 8 % of the distance to the hull near faces and edges (below it,
// always). All are rounded outwards. Movers beyond the limits of MAP.vfs are left out, and counted.
[[nodiscard]] std::vector<freespace::MoverShape> mover_shapes(const scene::Scene& scene, Stage& stage);

}  // namespace camdir::bake
