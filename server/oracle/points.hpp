// The obstacles of a point cloud: balls of one radius around its points.
#pragma once

#include <vector>

#include "oracle/embree_scene.hpp"
#include "oracle/surfaces.hpp"
#include "scene/scene.hpp"

namespace camdir::oracle {

class Points {
  public:
    Points(RTCDevice device, const scene::Scene& scene, double radius);

    // Distance to the nearest ball's surface, negative inside, as far as it is at most `limit` (>= 0), else
    // infinity; and that ball's centre.
    [[nodiscard]] Nearest nearest(const Vec3d& point, double limit) const;

    // No ball meets the closed segment, by steps from free ball to free ball; one that comes nearer than a
    // thousandth of the radius counts as meeting it.
    [[nodiscard]] bool segment_clear(const Vec3d& from, const Vec3d& to) const;

  private:
    std::vector<Vec3d> points_;
    double radius_;
    EmbreeScene scene_;
};

}  // namespace camdir::oracle
