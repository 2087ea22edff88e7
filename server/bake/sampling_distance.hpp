// The sampling distance d_s of the paper's section 4.1: how dense the samples of the obstacles are, and which
// Voronoi faces between them are freespace.
//
// Sampling condition: for every obstacle point x and every sample p nearest to x, |x - p| < d_s(p). Then no
// Voronoi face whose samples p1, p2 are at least 2 min(d_s(p1), d_s(p2)) apart touches an obstacle: its
// points x have p1 and p2 as nearest samples and are at least |p1 - p2| / 2 away from both. (The baker also
// takes faces of somewhat nearer samples, and removes those that touch an obstacle.)
//
// Uniform sampling is d_s = d0. Medial-axis adaptive sampling is d_s = max(d0, 3/4 d_m) up to a limit, where
// d_m is the distance to the medial axis: dense where the free space is narrow, sparse where it is wide. The
// samples on both sides of a medial face are 2 d_m apart or more, which 2 d_s = 3/2 d_m keeps with some
// room for an incompletely known medial axis.
#pragma once

#include <vector>

#include "bake/geometry/box_tree.hpp"

namespace camdir::bake {

// Immutable after construction, thread-safe.
class SamplingDistance {
  public:
    explicit SamplingDistance(double d0) : SamplingDistance(d0, d0, {}) {}

    // At least `d0`, at most `coarsest`.
    SamplingDistance(double d0, double coarsest, std::vector<Vec3d> medial_axis);

    [[nodiscard]] double finest() const { return d0_; }
    [[nodiscard]] double coarsest() const { return coarsest_; }

    // d_s at a point.
    [[nodiscard]] double at(const Vec3d& point) const;

    // The sampling condition holds when every obstacle point is nearer than this to one of the samples p
    // around it; `smallest` is the least d_s(p) of those samples.
    [[nodiscard]] double covering(double smallest) const;

    // Farther from the medial axis than this, the distance is the coarsest.
    [[nodiscard]] static double reach(double coarsest) { return coarsest / share; }

  private:
    static constexpr double share = 0.75;  // the paper's c0

    double d0_;
    double coarsest_;
    BoxTree tree_;
    std::vector<Vec3d> medial_axis_;  // in the tree's order
};

}  // namespace camdir::bake
