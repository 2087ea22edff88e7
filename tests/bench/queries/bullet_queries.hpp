// Bullet's sweeps against a map's triangles: what a spring arm uses.
#pragma once

#include <memory>

#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace camdir::bench {

class BulletQueries {
  public:
    explicit BulletQueries(const scene::Scene& scene);
    BulletQueries(BulletQueries&&) noexcept;
    ~BulletQueries();

    // The share of the way that the sphere goes before it touches a triangle; 1: all.
    [[nodiscard]] float sweep(const Vec3f& from, const Vec3f& to, float radius) const;
    // The same for a cube along the axes whose edges are 2 `half` long.
    [[nodiscard]] float sweep_cube(const Vec3f& from, const Vec3f& to, float half) const;

  private:
    struct World;
    std::unique_ptr<World> world_;
};

}  // namespace camdir::bench
