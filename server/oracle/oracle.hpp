// Clearance and visibility against the obstacles of a Scene, in double precision up to the stated rounding.
//
// Independent of the baker: it knows no mesh, no slab and no VFS-rep, and shares no code with bake/. Shared
// with the baker: the Scene, with whatever its reader did to the map (patches as flat triangles, welded
// vertices, surfaces left out). The obstacles of a point cloud are balls around its points: a solid each.
#pragma once

#include <limits>
#include <memory>

#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace camdir::oracle {

struct Nearest {
    double distance;
    Vec3d point;
};

// Immutable after construction; all const members are thread-safe. Points that are not finite are in no
// free space: clearance -infinity, nothing clear.
class Oracle {
  public:
    // `point_radius`: of the balls around a cloud's points, > 0 for clouds: the d0 of its MAP.vfs.
    explicit Oracle(const scene::Scene& scene, double point_radius = 0.0);
    Oracle(Oracle&&) noexcept;
    Oracle& operator=(Oracle&&) noexcept;
    ~Oracle();

    // Distance from `point` to the nearest obstacle, map units; inside a solid the negative depth below its
    // surface, 0 on it. Infinity when nothing is nearer than `limit`: a small limit makes the query cheaper.
    [[nodiscard]] double clearance(const Vec3d& point,
                                   double limit = std::numeric_limits<double>::infinity()) const;

    // The distance to the nearest obstacle, and the point to move away from: on its surface, in a cloud the
    // centre of its ball. For finite points in no solid. Distance infinity without obstacles within `limit`.
    [[nodiscard]] Nearest nearest(const Vec3d& point,
                                  double limit = std::numeric_limits<double>::infinity()) const;

    // No obstacle crosses or touches the closed segment. Exact up to the rounding of coordinates to float:
    // what comes nearer than that counts as a touch.
    [[nodiscard]] bool segment_clear(const Vec3d& from, const Vec3d& to) const;

    // Its parts, for many segments that share an end: segment_clear() is end_clear() of both ends, with the
    // `largest` absolute coordinate of the two, and between_clear(). An end with more clearance than
    // 2^-20 `largest` is clear.
    [[nodiscard]] bool end_clear(const Vec3d& end, double largest) const;
    [[nodiscard]] bool between_clear(const Vec3d& from, const Vec3d& to) const;

    // Inside a solid or on its surface. Brushes are tested by their planes alone; a mesh has no solids.
    [[nodiscard]] bool in_solid(const Vec3d& point) const;

    // No obstacle reaches into the ball. Conservative: may be false when a brush's edge only comes near.
    [[nodiscard]] bool ball_clear(const Vec3d& centre, double radius) const;

  private:
    struct Structures;
    std::unique_ptr<Structures> structures_;
};

}  // namespace camdir::oracle
