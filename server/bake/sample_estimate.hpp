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
    // Of a cloud that has so many points left at this d0 (map units): they are its samples.
    SampleEstimate(double points, double d0) : cloud_points_(points), cloud_d0_(d0) {}

    // Measures the sampling distance at some points of the scene's triangles, spread by rule, so that the
    // same scene gives the same estimate. `slack` as for sample().
    SampleEstimate(const scene::Scene& scene, const Solids& solids, const SamplingDistance& distance,
                   double slack);

    // With a sampling distance of at least `d0` (map units), which should be no smaller than that measured:
    // within a third of what sample() makes. Without those of the shell.
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
    double cloud_points_ = 0.0;
    double cloud_d0_ = 0.0;
};

}  // namespace camdir::bake
