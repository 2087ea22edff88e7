// How many samples the obstacles are going to have, before they are made.
#pragma once

#include <vector>

#include "bake/geometry/solids.hpp"
#include "bake/sampling_distance.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// Immutable, thread-safe.
class SampleEstimate {
  public:
    // Of obstacles whose samples are known for this d0 (map units).
    SampleEstimate(double samples, double d0) : known_samples_(samples), known_d0_(d0) {}

    // Measures the sampling distance at some points of the scene's triangles, spread by rule, so that the
    // same scene gives the same estimate. `slack` as for sample().
    SampleEstimate(const scene::Scene& scene, const Solids& solids, const SamplingDistance& distance,
                   double slack);

    // With a sampling distance of at least `d0` (map units), which should be no smaller than that measured:
    // on 12 maps of OpenArena 0.4 (open terrain) to 1.25 times what sampling and thinning leave. Without
    // those of the shell.
    [[nodiscard]] double samples(double d0) const;

  private:
    struct Probe {  // where the obstacles bound free space
        double sampling_distance;
        double area, length;    // of its triangle; the length of the longest edge
        double triangle_share;  // how much of its triangle it stands for
    };
    std::vector<Probe> probes_;
    double corners_ = 0.0;
    double slack_ = 0.0;
    double known_samples_ = 0.0;
    double known_d0_ = 0.0;
};

}  // namespace camdir::bake
