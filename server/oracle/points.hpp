// The obstacles of a point cloud: balls of one radius around its points.
#pragma once

#include <vector>

#include "oracle/embree_scene.hpp"
#include "oracle/oracle.hpp"
#include "scene/scene.hpp"

namespace camdir::oracle {

class Points {
  public:
    Points(RTCDevice device, const scene::Scene& scene, double radius);

    // Distance to the nearest ball's surface, negative inside, and that ball's centre; distance infinity when
    // it is more than `limit` (>= 0).
    [[nodiscard]] Nearest nearest(const Vec3d& point, double limit) const;

    // No ball meets the closed segment. Steps from free ball to free ball: one that comes nearer than a
    // thousandth of the radius counts as meeting it.
    [[nodiscard]] bool segment_clear(const Vec3d& from, const Vec3d& to) const;

  private:
    std::vector<Vec3d> points_;
    double radius_;
    EmbreeScene scene_;
};

}  // namespace camdir::oracle
