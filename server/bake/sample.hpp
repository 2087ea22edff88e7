// Sampling of the obstacles: the paper's section 4.1.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/geometry/solids.hpp"
#include "bake/geometry/triangle.hpp"
#include "bake/sampling_distance.hpp"
#include "bake/stage.hpp"

namespace camdir::bake {

// The Voronoi diagram of that many samples takes about 10 GB.
inline constexpr std::uint64_t max_samples = 20'000'000;

// The error for a requested `distance` (map units) that takes `at_least` samples; says what to change.
[[nodiscard]] tl::unexpected<Error> too_many_samples(const scene::Scene& scene, double distance,
                                                     double at_least);

// Fails early when the area alone shows that even samples `coarsest` apart are more than that, as with a map
// whose unit is wrong. `finest` is the requested distance, for the message.
[[nodiscard]] Result<void> check_sample_count(const scene::Scene& scene, double coarsest, double finest);

// Points on the scene's triangles that satisfy the sampling condition of `distance` (sampling_distance.hpp)
// wherever the obstacles bound free space, also after every sample was moved, or replaced by another one, by
// less than `slack`. Surfaces buried in `solids` need no samples: free points are nearer to other surfaces.
// Triangles of samples p have edges shorter than twice the least covering() of their corners. (The paper's
// rule, edges alone, misses its own sampling condition by up to 14 %.) Points of shared edges repeat. Fails
// with more than `limit`.
[[nodiscard]] Result<std::vector<Vec3d>> sample(const scene::Scene& scene, const Solids& solids,
                                                const SamplingDistance& distance, double slack, Stage& stage,
                                                std::uint64_t limit = max_samples);

// d_s at each sample.
[[nodiscard]] Result<std::vector<double>> distances_at(const std::vector<Vec3d>& samples,
                                                       const SamplingDistance& distance, Stage& stage);

}  // namespace camdir::bake
