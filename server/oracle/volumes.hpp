// The obstacles' brushes: what is inside, by their planes alone.
#pragma once

#include <vector>

#include "oracle/embree_scene.hpp"
#include "scene/scene.hpp"

namespace camdir::oracle {

class Volumes {
  public:
    Volumes(RTCDevice device, const scene::Scene& scene);

    // How deep `point` lies below the surface of the brush that holds it most deeply; < 0: in none.
    // A point on a brush's surface has depth 0.
    [[nodiscard]] double depth(const Vec3d& point) const;

    // No brush reaches into the ball. Conservative: may be false for a brush that only comes near.
    [[nodiscard]] bool ball_clear(const Vec3d& centre, double radius) const;

  private:
    [[nodiscard]] double depth_in(const scene::Brush& brush, const Vec3d& point) const;

    std::vector<scene::Plane> planes_;
    std::vector<scene::Brush> brushes_;
    EmbreeScene scene_;
};

}  // namespace camdir::oracle
