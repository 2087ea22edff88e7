// Scenes made of solid boxes, whose clearance is known in closed form.
#pragma once

#include <vector>

#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace camdir::test {

// Builds a Scene box by box: each is a brush and twelve obstacle triangles. 0.0254 metres a unit.
class SolidScene {
  public:
    // Six walls of thickness 16 around `inside`.
    explicit SolidScene(const Box3d& inside);

    SolidScene& add(const Box3d& solid);
    SolidScene& spawn(const Vec3d& eye);

    [[nodiscard]] const scene::Scene& scene() const { return scene_; }

    // Exact distance to the nearest solid; 0 inside one.
    [[nodiscard]] double clearance(const Vec3d& point) const;

  private:
    scene::Scene scene_;
    std::vector<Box3d> solids_;
};

// A room of 256 x 192 x 128 with a spawn point.
[[nodiscard]] SolidScene box_room();

// The same with a pillar of 32 x 32 from floor to ceiling.
[[nodiscard]] SolidScene pillar_room();

// Two rooms of 256 x 256 x 128, x < -8 and x > 8, joined by a door of 64 x 96; a spawn point only in the
// first.
[[nodiscard]] SolidScene two_rooms();

}  // namespace camdir::test
