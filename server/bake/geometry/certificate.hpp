// The certificate: how far a slab stays away from the obstacles themselves, whatever their sampling was. In
// closed form, up to the rounding of doubles.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "bake/geometry/ball_hull.hpp"
#include "bake/geometry/obstacles.hpp"
#include "bake/geometry/triangle.hpp"
#include "freespace/freespace.hpp"

namespace camdir::bake {

// The smallest of |m - q| - r(m) over the points m of the medial triangle (free distance r(m)) and the points
// q of an obstacle: >= 0 when no ball of the slab reaches into the obstacle, < 0 when one does.
struct SignedGap {
    double value = std::numeric_limits<double>::infinity();
    std::array<double, 3> weights{};  // barycentric coordinates of the m where it is attained
};

// The slab S_f of one medial triangle: corners and free distances, which may be negative. "Tilted" slabs have
// different free distances, so that their two sides incline towards each other. Immutable, thread-safe. No
// function allocates.
class Slab {
  public:
    Slab(const Triangle3d& corners, const std::array<double, 3>& free_distance);

    // The gap to one obstacle triangle, which may be a segment or a point.
    [[nodiscard]] SignedGap signed_gap(const Triangle3d& obstacle) const;

    // Cheap lower bounds of the gap: those of the hull of the balls at the corners.
    [[nodiscard]] double min_gap(const Box3d& box) const { return hull().min_gap(box); }
    [[nodiscard]] double min_gap(const Triangle3d& obstacle) const { return hull().min_gap(obstacle); }

    // The largest r(m) - |m - point| over the points m of the triangle: the free distance that the slab gives
    // to the point; not positive when the point is outside.
    [[nodiscard]] double distance(const Vec3d& point) const { return -towards_point(point).value; }

    [[nodiscard]] const Triangle3d& corners() const { return corners_; }
    [[nodiscard]] const std::array<double, 3>& free_distance() const { return free_distance_; }

  private:
    [[nodiscard]] BallHull<3> hull() const { return {corners_, free_distance_}; }

    // The best m towards one point: the maximiser of r(m) - |m - q|. By the closed form on a tilted slab.
    [[nodiscard]] SignedGap towards_point(const Vec3d& q) const;
    [[nodiscard]] SignedGap from_edge_to_point(int edge, const Vec3d& q) const;
    [[nodiscard]] SignedGap from_edge_to_edge(int edge, const Vec3d& a, const Vec3d& b) const;
    [[nodiscard]] SignedGap from_corner(int corner, const Triangle3d& obstacle) const;
    [[nodiscard]] SignedGap where_crossing(const Triangle3d& obstacle) const;
    [[nodiscard]] SignedGap at(const std::array<double, 3>& weights, const Vec3d& q) const;

    Triangle3d corners_;
    std::array<double, 3> free_distance_;
    Vec3d normal_;        // not of unit length
    double area2_;        // squared length of normal_
    Vec3d incline_;       // from the foot of a point at distance 1 above the triangle to the best m for it
    bool steep_ = false;  // r grows faster than the distance: the best m is always on an edge
};

// The smallest gap to any obstacle when it is less than `enough`; otherwise `enough`, without weights.
[[nodiscard]] SignedGap signed_gap(const Slab& slab, const Obstacles& obstacles, double enough);

// The position of an obstacle that a ball of the slabs reaches into, or none. The slabs should lie close
// together: obstacles outside their common hull are rejected for all at once. `hint`, an obstacle that was
// found for similar slabs, is tried first.
[[nodiscard]] std::uint32_t find_violated(std::span<const Slab> slabs, const Obstacles& obstacles,
                                          std::uint32_t hint = freespace::none);

// No ball of the slab reaches into an obstacle: signed_gap() would be at least 0.
[[nodiscard]] bool is_certified(const Slab& slab, const Obstacles& obstacles);

}  // namespace camdir::bake
