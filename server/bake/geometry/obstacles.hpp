// The scene's obstacles under a spatial index: its triangles, or the points of a cloud.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "bake/geometry/box_tree.hpp"
#include "bake/geometry/triangle.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// Immutable after construction, thread-safe.
class Obstacles {
  public:
    explicit Obstacles(const scene::Scene& scene);

    // In the tree's order: positions that tree() reports index them. A point is a triangle whose corners
    // coincide.
    [[nodiscard]] const std::vector<Triangle3d>& triangles() const { return triangles_; }
    [[nodiscard]] const BoxTree& tree() const { return tree_; }

    // The obstacle point nearest to `point`, when one is nearer than `within`.
    [[nodiscard]] std::optional<Vec3d> nearest(const Vec3d& point, double within) const;

    // Distance to the nearest obstacle, or `at_most` when none is nearer. Up to the rounding of doubles.
    [[nodiscard]] double distance(const Vec3d& point,
                                  double at_most = std::numeric_limits<double>::infinity()) const;

  private:
    BoxTree tree_;
    std::vector<Triangle3d> triangles_;
};

}  // namespace camdir::bake
