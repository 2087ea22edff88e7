// The scene's solid brushes under a spatial index.
#pragma once

#include "bake/geometry/box_tree.hpp"
#include "bake/geometry/triangle.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// Immutable after construction, thread-safe. The scene must outlive it.
class Solids {
  public:
    explicit Solids(const scene::Scene& scene);

    // Inside or on the surface of a brush; always false for scenes that know no volumes.
    [[nodiscard]] bool contains(const Vec3d& point) const;

    // At `offset` from the triangle both sides are solid: it bounds no free space. Conservative: false also
    // when only several brushes together bury it.
    [[nodiscard]] bool is_buried(const Triangle3d& triangle, double offset) const;

  private:
    // One brush contains all of the triangle.
    [[nodiscard]] bool is_covered(const Triangle3d& triangle) const;

    const scene::Scene& scene_;
    BoxTree tree_;
};

}  // namespace camdir::bake
