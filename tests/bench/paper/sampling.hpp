// The paper's sampling rule (section 4.1), as written.
#pragma once

#include <vector>

#include "bake/geometry/triangle.hpp"
#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::paper {

// Splits edges of length >= 2 * d0 at their midpoints, until there are none. Every sample once, ascending
// (x, y, z). The rule bounds the edges alone: obstacle points may be farther than d0 from every sample.
// Fails with more than bake::max_samples, and without triangles.
[[nodiscard]] Result<std::vector<Vec3d>> sample(const scene::Scene& scene, double d0);

// The samples of one triangle beyond its corners, appended; midpoints of shared edges repeat. False when
// there are more than bake::max_samples.
[[nodiscard]] bool split_long_edges(const bake::Triangle3d& triangle, double d0, std::vector<Vec3d>& samples);

}  // namespace camdir::paper
