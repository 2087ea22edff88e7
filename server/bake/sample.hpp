// Sampling of the obstacles: the paper's section 4.1, uniform.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/stage.hpp"
#include "bake/triangle.hpp"

namespace camdir::bake {

// More samples than this are refused: their Voronoi diagram takes about 10 GB.
inline constexpr std::uint64_t max_samples = 20'000'000;

// Largest distance from a point of the triangle to the nearest of its corners.
[[nodiscard]] double covering_radius(const Triangle3d& triangle);

// Points on the scene's triangles, each triangle's corners included, such that every obstacle point has a
// sample nearer than `distance`, and triangles of samples have edges shorter than 2 * distance. (The
// paper's rule, edges alone, misses its own sampling condition by up to 14 %.) Points of shared edges repeat.
// Fails with more than max_samples.
[[nodiscard]] Result<std::vector<Vec3d>> sample(const scene::Scene& scene, double distance, Stage& stage);

}  // namespace camdir::bake
