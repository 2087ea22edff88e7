#include "support/mover_twins.hpp"

#include <algorithm>
#include <limits>

namespace camdir::test {
namespace {

using freespace::ConvexHull;
using freespace::HalfSpace;

constexpr double on_plane = 1e-4;

float number_between(std::mt19937& random, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
}

Vec3f random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    const Vec3f direction(normal(random), normal(random), normal(random));
    return direction.normalized();
}

double height_over(const HalfSpace& plane, const Vec3d& point) {
    return plane.normal.cast<double>().dot(point) - plane.distance;
}

bool inside(const ConvexHull& hull, const Vec3d& point, double tolerance) {
    return std::all_of(hull.half_spaces.begin(), hull.half_spaces.end(),
                       [&](const HalfSpace& plane) { return height_over(plane, point) <= tolerance; });
}

double distance_of_segment(const Vec3d& a, const Vec3d& b, const Vec3d& point) {
    const Vec3d way = b - a;
    const double share = std::clamp((point - a).dot(way) / std::max(way.squaredNorm(), 1e-12), 0.0, 1.0);
    return (point - a - share * way).norm();
}

}  // namespace

ConvexHull box_hull(const Vec3f& min, const Vec3f& max) {
    ConvexHull hull;
    for (int axis = 0; axis < 3; ++axis) {
        hull.half_spaces.push_back({Vec3f::Unit(axis), max[axis]});
        hull.half_spaces.push_back({-Vec3f::Unit(axis), -min[axis]});
    }
    hull.bounds = Box3f(min, max);
    return hull;
}

std::vector<Vec3d> corners_of(const ConvexHull& hull) {
    std::vector<Vec3d> corners;
    const auto& planes = hull.half_spaces;
    for (std::size_t i = 0; i < planes.size(); ++i)
        for (std::size_t j = i + 1; j < planes.size(); ++j)
            for (std::size_t k = j + 1; k < planes.size(); ++k) {
                Eigen::Matrix3d normals;
                normals << planes[i].normal.cast<double>().transpose(),
                    planes[j].normal.cast<double>().transpose(), planes[k].normal.cast<double>().transpose();
                if (std::abs(normals.determinant()) < 1e-6) continue;
                const Vec3d corner =
                    normals.inverse() * Vec3d(planes[i].distance, planes[j].distance, planes[k].distance);
                if (inside(hull, corner, on_plane)) corners.push_back(corner);
            }
    return corners;
}

ConvexHull random_hull(std::mt19937& random, const Vec3f& centre) {
    ConvexHull hull;
    const auto add = [&](const Vec3f& normal, float nearest, float furthest) {
        hull.half_spaces.push_back({normal, normal.dot(centre) + number_between(random, nearest, furthest)});
    };
    for (int axis = 0; axis < 3; ++axis) {
        add(Vec3f::Unit(axis), 5.0F, 50.0F);
        add(-Vec3f::Unit(axis), 5.0F, 50.0F);
    }
    for (std::size_t i = random() % 11; i-- > 0;)
        add(random_direction(random), 4.0F, 40.0F);
    for (const Vec3d& corner : corners_of(hull))
        hull.bounds.extend(corner.cast<float>());
    return hull;
}

freespace::MoverShape random_mover(std::mt19937& random, const std::string& name) {
    freespace::MoverShape shape;
    shape.name = name;
    const auto place = [&] { return Vec3f(random_direction(random) * number_between(random, 0.0F, 60.0F)); };
    for (std::size_t i = 1 + random() % 3; i-- > 0;)
        shape.hulls.push_back(random_hull(random, place()));
    for (std::size_t i = random() % 3; i-- > 0;)
        shape.balls.push_back({place(), number_between(random, 3.0F, 30.0F)});
    return shape;
}

Quatf random_rotation(std::mt19937& random, float largest_angle) {
    return Quatf(Eigen::AngleAxisf(number_between(random, 0.0F, largest_angle), random_direction(random)));
}

PlacedMover::PlacedMover(const freespace::MoverShape& shape, const Vec3d& position,
                         const Eigen::Quaterniond& orientation)
    : balls_(shape.balls), position_(position), orientation_(orientation) {
    for (const ConvexHull& planes : shape.hulls) {
        Hull hull{planes, {}};
        for (const Vec3d& place : corners_of(planes)) {
            Corner corner{place, {}};
            for (std::size_t i = 0; i < planes.half_spaces.size(); ++i)
                if (height_over(planes.half_spaces[i], place) > -on_plane) corner.planes.push_back(i);
            hull.corners.push_back(corner);
        }
        hulls_.push_back(hull);
    }
}

bool PlacedMover::contains(const Vec3d& point) const {
    const Vec3d local = orientation_.conjugate() * (point - position_);
    return std::any_of(hulls_.begin(), hulls_.end(),
                       [&](const Hull& hull) { return inside(hull.planes, local, 0.0); }) ||
           std::any_of(balls_.begin(), balls_.end(), [&](const freespace::MoverBall& ball) {
               return (local - ball.centre.cast<double>()).norm() <= ball.radius;
           });
}

double PlacedMover::distance(const Vec3d& point) const {
    if (contains(point)) return 0.0;
    const Vec3d local = orientation_.conjugate() * (point - position_);
    double least = std::numeric_limits<double>::infinity();
    for (const Hull& hull : hulls_)
        least = std::min(least, distance(hull, local));
    for (const freespace::MoverBall& ball : balls_)
        least = std::min(least, (local - ball.centre.cast<double>()).norm() - ball.radius);
    return least;
}

// Of its faces, edges and corners.
double PlacedMover::distance(const Hull& hull, const Vec3d& point) {
    double least = std::numeric_limits<double>::infinity();
    for (const HalfSpace& plane : hull.planes.half_spaces) {
        const double height = height_over(plane, point);
        if (height > 0.0 && inside(hull.planes, point - height * plane.normal.cast<double>(), on_plane))
            least = std::min(least, height);
    }
    for (const Corner& a : hull.corners)
        for (const Corner& b : hull.corners) {
            const auto shared = std::count_if(a.planes.begin(), a.planes.end(), [&](std::size_t plane) {
                return std::find(b.planes.begin(), b.planes.end(), plane) != b.planes.end();
            });
            if (shared >= 2) least = std::min(least, distance_of_segment(a.place, b.place, point));
        }
    return least;
}

}  // namespace camdir::test
