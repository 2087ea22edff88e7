// Random movers, and the slow, obvious twins of their queries: in double precision, feature by feature of a
// hull and instant by instant of a way.
#pragma once

#include <random>
#include <vector>

#include "freespace/mover_shape.hpp"

namespace camdir::test {

// An axis-aligned box as a hull.
[[nodiscard]] freespace::ConvexHull box_hull(const Vec3f& min, const Vec3f& max);

// The corners of a hull: where three of its planes meet and nothing is outside.
[[nodiscard]] std::vector<Vec3d> corners_of(const freespace::ConvexHull& hull);

// A hull round `centre`, some tens of units wide: a box, cut by up to ten random half spaces.
[[nodiscard]] freespace::ConvexHull random_hull(std::mt19937& random, const Vec3f& centre);

// One to three hulls and none to two balls, around the origin.
[[nodiscard]] freespace::MoverShape random_mover(std::mt19937& random, const std::string& name);

[[nodiscard]] Quatf random_rotation(std::mt19937& random, float largest_angle);

// A mover somewhere: exact answers about it.
class PlacedMover {
  public:
    PlacedMover(const freespace::MoverShape& shape, const Vec3d& position,
                const Eigen::Quaterniond& orientation);

    void place(const Vec3d& position, const Eigen::Quaterniond& orientation) {
        position_ = position;
        orientation_ = orientation;
    }

    [[nodiscard]] bool contains(const Vec3d& point) const;
    // 0 inside.
    [[nodiscard]] double distance(const Vec3d& point) const;

  private:
    struct Corner {
        Vec3d place;
        std::vector<std::size_t> planes;  // that meet there
    };
    struct Hull {
        freespace::ConvexHull planes;
        std::vector<Corner> corners;
    };
    [[nodiscard]] static double distance(const Hull& hull, const Vec3d& point);

    std::vector<Hull> hulls_;
    std::vector<freespace::MoverBall> balls_;
    Vec3d position_;
    Eigen::Quaterniond orientation_;
};

}  // namespace camdir::test
