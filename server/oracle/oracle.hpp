// Exact clearance and visibility against the source scene. The obstacles of a point cloud are balls around
// its points: a solid each. It never looks at a VFS-rep: verify, evaluate and the tests judge with it.
#pragma once

#include <limits>
#include <memory>

#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace camdir::oracle {

// Immutable after construction; all const members are thread-safe. Points that are not finite are in no
// free space: clearance -infinity, nothing clear, not reachable.
class Oracle {
  public:
    // `point_radius`: of the balls around a cloud's points, > 0 for clouds; MAP.vfs says it (d0).
    explicit Oracle(const scene::Scene& scene, double point_radius = 0.0);
    Oracle(Oracle&&) noexcept;
    Oracle& operator=(Oracle&&) noexcept;
    ~Oracle();

    // Distance from `point` to the nearest obstacle, map units; inside a solid the negative depth below its
    // surface (never positive there). Infinity when nothing is nearer than
    // `limit`: a small limit makes the query cheaper.
    [[nodiscard]] double clearance(const Vec3d& point,
                                   double limit = std::numeric_limits<double>::infinity()) const;

    // No obstacle crosses or touches the closed segment. Exact up to the rounding of
    // coordinates to float: what comes nearer than that counts as a touch.
    [[nodiscard]] bool segment_clear(const Vec3d& from, const Vec3d& to) const;

    // Its parts, for many segments with an end in common: segment_clear() is end_clear() of both ends, with
    // the `largest` coordinate of the two, and between_clear(). Clearance beyond 2^-20 `largest` makes a
    // clear end.
    [[nodiscard]] bool end_clear(const Vec3d& end, double largest) const;
    [[nodiscard]] bool between_clear(const Vec3d& from, const Vec3d& to) const;

    // Inside a solid or on its surface: of brushes by their planes alone; always false for meshes, which have
    // none.
    [[nodiscard]] bool in_solid(const Vec3d& point) const;

    // No obstacle reaches into the ball. May be false for a ball that a brush's edge only
    // comes near.
    [[nodiscard]] bool ball_clear(const Vec3d& centre, double radius) const;

    // In no solid, and joined to a spawn point by free space: not outside the sealed map. True is proved by
    // a chain of overlapping free balls and free segments; false may be wrong for a point in a crack
    // narrower than 8 units (of 0.0254 m; 4 in a cloud). The first call explores the map and takes longer.
    [[nodiscard]] bool reachable(const Vec3d& point) const;

  private:
    struct Structures;
    std::unique_ptr<Structures> structures_;
};

}  // namespace camdir::oracle
