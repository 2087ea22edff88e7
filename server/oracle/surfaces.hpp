// The obstacles' triangles: nearest point and occlusion.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "oracle/embree_scene.hpp"
#include "oracle/oracle.hpp"
#include "scene/scene.hpp"

namespace camdir::oracle {

// The point of the closed triangle that is nearest to `point`.
[[nodiscard]] Vec3d closest_on_triangle(const Vec3d& point, const Vec3d& a, const Vec3d& b, const Vec3d& c);

class Surfaces {
  public:
    Surfaces(RTCDevice device, const scene::Scene& scene);

    // Nearest obstacle point within `limit`; else distance infinity. In double precision: Embree only finds
    // the candidates.
    [[nodiscard]] Nearest nearest(const Vec3d& point, double limit) const;

    // No triangle comes as near to `end` as the rounding to float of coordinates up to `largest` may hide.
    [[nodiscard]] bool end_clear(const Vec3d& end, double largest) const;

    // Of a segment whose ends are clear: Embree's watertight test, on vertices rounded to float.
    [[nodiscard]] bool between_clear(const Vec3d& from, const Vec3d& to) const;

  private:
    std::vector<Vec3d> vertices_;
    std::vector<std::array<std::uint32_t, 3>> triangles_;
    double rounding_ = 0.0;
    EmbreeScene scene_;
};

}  // namespace camdir::oracle
