// The scene's solid brushes under a spatial index.
#pragma once

#include "bake/box_tree.hpp"
#include "scene/scene.hpp"

namespace camdir::bake {

// Immutable after construction, thread-safe. The scene must outlive it.
class Solids {
  public:
    explicit Solids(const scene::Scene& scene);

    // Inside or on the surface of a brush; always false for scenes that know no volumes.
    [[nodiscard]] bool contain(const Vec3d& point) const;

  private:
    const scene::Scene& scene_;
    BoxTree tree_;
};

}  // namespace camdir::bake
