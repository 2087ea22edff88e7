// The convex hull of some balls, and a lower bound of its distance from an obstacle: the cheap part of the
// certificate.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "bake/geometry/triangle.hpp"

namespace camdir::bake {

// A view of at least one ball; radii may be negative. A slab is the hull of the balls at its corners. With
// the number known the loops unroll.
template <std::size_t count = std::dynamic_extent>
class BallHull {
  public:
    BallHull(std::span<const Vec3d, count> centres, std::span<const double, count> radii)
        : centres_(centres), radii_(radii), middle_(Vec3d::Zero()) {
        const double share = 1.0 / static_cast<double>(centres.size());
        for (std::size_t i = 0; i < centres.size(); ++i) {
            middle_ += share * centres[i];
            middle_radius_ += share * radii[i];
        }
    }

    // The support function: the largest coordinate along `direction` (of length <= 1) of the hull's points.
    [[nodiscard]] double support(const Vec3d& direction) const {
        double largest = of_ball(direction, 0);
        for (std::size_t i = 1; i < centres_.size(); ++i)
            largest = std::max(largest, of_ball(direction, i));
        return largest;
    }

    // Lower bounds of the smallest |m - q| - r over the hull's balls (m, r) and the points q of an obstacle,
    // by a direction that separates the two. For a triangle the search for a direction ends with the first
    // that gives 0 or more.
    [[nodiscard]] double min_gap(const Box3d& box) const;
    [[nodiscard]] double min_gap(const Triangle3d& obstacle) const;

  private:
    [[nodiscard]] double of_ball(const Vec3d& direction, std::size_t ball) const {
        return direction.dot(centres_[ball]) + radii_[ball];
    }
    [[nodiscard]] std::size_t farthest(const Vec3d& direction) const;

    // Both of the obstacle's normals as the direction.
    [[nodiscard]] double min_gap_by_plane(const Triangle3d& obstacle) const;

    std::span<const Vec3d, count> centres_;
    std::span<const double, count> radii_;
    Vec3d middle_;
    double middle_radius_ = 0.0;
};

template <std::size_t count>
std::size_t BallHull<count>::farthest(const Vec3d& direction) const {
    std::size_t ball = 0;
    double largest = of_ball(direction, 0);
    for (std::size_t i = 1; i < centres_.size(); ++i) {
        const double other = of_ball(direction, i);
        if (!(other > largest)) continue;
        largest = other;
        ball = i;
    }
    return ball;
}

template <std::size_t count>
double BallHull<count>::min_gap(const Box3d& box) const {
    const Vec3d nearest = middle_.cwiseMax(box.min()).cwiseMin(box.max());
    const Vec3d to_box = nearest - middle_;
    const double distance = to_box.norm();
    if (!(distance > 0.0)) return -std::numeric_limits<double>::infinity();
    const Vec3d direction = to_box / distance;
    // The nearest point of a box to a point outside is also its lowest along the direction to it.
    return direction.dot(nearest) - support(direction);
}

template <std::size_t count>
double BallHull<count>::min_gap_by_plane(const Triangle3d& obstacle) const {
    const Vec3d normal = (obstacle[1] - obstacle[0]).cross(obstacle[2] - obstacle[0]);
    const double length = normal.norm();
    const double side = normal.dot(middle_ - obstacle[0]);
    if (!(length > 0.0)) return -std::numeric_limits<double>::infinity();
    const Vec3d direction = normal / (side < 0.0 ? length : -length);
    return direction.dot(obstacle[0]) - support(direction);
}

// Walks from the middle towards the m of the smallest gap, after Frank and Wolfe: the direction to the
// nearest point of the obstacle separates the two, or else the walk goes towards the ball that supports the
// hull along it. Separates three of four obstacles that the middle's own direction does not, at a fraction of
// the cost of the gap itself.
template <std::size_t count>
double BallHull<count>::min_gap(const Triangle3d& obstacle) const {
    constexpr int max_steps = 8;
    constexpr double stride = 0.4;
    double bound = min_gap_by_plane(obstacle);
    Vec3d m = middle_;
    double r = middle_radius_;
    for (int step = 0; step < max_steps && bound < 0.0; ++step) {
        const Vec3d to_obstacle = closest_point(obstacle, m) - m;
        const double distance = to_obstacle.norm();
        if (!(distance > std::max(r, 0.0))) break;  // nothing separates them
        const Vec3d direction = to_obstacle / distance;
        const double lowest =
            std::min({direction.dot(obstacle[0]), direction.dot(obstacle[1]), direction.dot(obstacle[2])});
        const std::size_t ball = farthest(direction);
        bound = std::max(bound, lowest - of_ball(direction, ball));
        m += stride * (centres_[ball] - m);
        r += stride * (radii_[ball] - r);
    }
    return bound;
}

}  // namespace camdir::bake
