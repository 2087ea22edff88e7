#include "support/oracle_twins.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <span>

namespace camdir::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double distance_to_segment(const Vec3d& point, const Vec3d& a, const Vec3d& b) {
    const Vec3d along = b - a;
    const double t = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (a + t * along - point).norm();
}

// By the normal equations; clamping one parameter after the other reaches the optimum in two rounds.
double distance_of_segments(const Vec3d& p, const Vec3d& q, const Vec3d& a, const Vec3d& b) {
    double smallest = std::min({distance_to_segment(p, a, b), distance_to_segment(q, a, b),
                                distance_to_segment(a, p, q), distance_to_segment(b, p, q)});
    const Vec3d u = q - p;
    const Vec3d v = b - a;
    Eigen::Matrix2d normal;
    normal << u.squaredNorm(), -u.dot(v), -u.dot(v), v.squaredNorm();
    const Eigen::Vector2d right(u.dot(a - p), -v.dot(a - p));
    if (normal.determinant() > 0.0) {
        const Eigen::Vector2d t = normal.inverse() * right;
        if (t.minCoeff() >= 0.0 && t.maxCoeff() <= 1.0)
            smallest = std::min(smallest, (p + t.x() * u - a - t.y() * v).norm());
    }
    return smallest;
}

bool meets(const Vec3d& from, const Vec3d& to, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    Eigen::Matrix3d system;
    system << b - a, c - a, from - to;
    if (std::abs(system.determinant()) < 1e-12) return false;
    const Vec3d solution = system.fullPivLu().solve(from - a);
    return solution.minCoeff() >= 0.0 && solution.x() + solution.y() <= 1.0 && solution.z() <= 1.0;
}

}  // namespace

double distance_to_triangle(const Vec3d& point, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    Eigen::Matrix<double, 3, 2> sides;
    sides << b - a, c - a;
    const Eigen::Vector2d weights = sides.colPivHouseholderQr().solve(point - a);
    if (weights.minCoeff() >= 0.0 && weights.sum() <= 1.0) return (a + sides * weights - point).norm();
    return std::min({distance_to_segment(point, a, b), distance_to_segment(point, b, c),
                     distance_to_segment(point, c, a)});
}

double distance_to_triangle(const Vec3d& from, const Vec3d& to, const Vec3d& a, const Vec3d& b,
                            const Vec3d& c) {
    if (meets(from, to, a, b, c)) return 0.0;
    return std::min({distance_to_triangle(from, a, b, c), distance_to_triangle(to, a, b, c),
                     distance_of_segments(from, to, a, b), distance_of_segments(from, to, b, c),
                     distance_of_segments(from, to, c, a)});
}

double depth_in_solid(const scene::Scene& scene, const Vec3d& point) {
    double deepest = -infinity;
    for (const scene::Brush& brush : scene.brushes) {
        double depth = infinity;
        for (const auto& plane : std::span(scene.planes).subspan(brush.first_plane, brush.plane_count)) {
            depth = std::min(depth, plane.distance - plane.normal.dot(point));
        }
        deepest = std::max(deepest, depth);
    }
    return deepest;
}

double clearance(const scene::Scene& scene, const Vec3d& point) {
    const double depth = depth_in_solid(scene, point);
    if (depth >= 0.0) return -depth;
    double smallest = infinity;
    for (const auto& [a, b, c] : scene.triangles) {
        smallest = std::min(
            smallest, distance_to_triangle(point, scene.vertices[a], scene.vertices[b], scene.vertices[c]));
    }
    return smallest;
}

double clearance(const scene::Scene& scene, const Vec3d& from, const Vec3d& to) {
    double smallest = infinity;
    for (const auto& [a, b, c] : scene.triangles) {
        smallest = std::min(smallest, distance_to_triangle(from, to, scene.vertices[a], scene.vertices[b],
                                                           scene.vertices[c]));
    }
    return smallest;
}

}  // namespace camdir::test
