#include "support/bake_twins.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace camdir::test {
namespace {

using bake::Triangle3d;

// Two numbers in [0, 1] stand for a point of a triangle; all of the triangle is reached.
std::array<double, 3> weights_of(double s, double t) {
    const double sum = std::max(1.0, s + t);
    return {1.0 - (s + t) / sum, s / sum, t / sum};
}

}  // namespace

Vec3d point_of(const Triangle3d& triangle, const std::array<double, 3>& weights) {
    return weights[0] * triangle[0] + weights[1] * triangle[1] + weights[2] * triangle[2];
}

double searched_signed_gap(const Triangle3d& corners, const std::array<double, 3>& free_distance,
                           const Triangle3d& obstacle) {
    constexpr int steps = 3;  // on each side of the best so far
    std::array<double, 4> centre{0.5, 0.5, 0.5, 0.5};
    std::array<double, 4> best_at = centre;
    double best = std::numeric_limits<double>::infinity();
    for (double width = 0.5; width > 1e-7; width *= 0.6) {
        for (int cell = 0; cell < 7 * 7 * 7 * 7; ++cell) {
            std::array<double, 4> x{};
            for (int k = 0, rest = cell; k < 4; ++k, rest /= 7)
                x[k] = std::clamp(centre[k] + width * (rest % 7 - steps) / steps, 0.0, 1.0);
            const auto weights = weights_of(x[0], x[1]);
            const Vec3d m = point_of(corners, weights);
            const Vec3d q = point_of(obstacle, weights_of(x[2], x[3]));
            const double r =
                weights[0] * free_distance[0] + weights[1] * free_distance[1] + weights[2] * free_distance[2];
            const double value = (m - q).norm() - r;
            if (value < best) {
                best = value;
                best_at = x;
            }
        }
        centre = best_at;
    }
    return best;
}

double searched_distance(const Vec3d& point, const Triangle3d& triangle) {
    return searched_signed_gap({point, point, point}, {0.0, 0.0, 0.0}, triangle);
}

double distance_to_nearest(const Vec3d& point, const std::vector<Vec3d>& points) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Vec3d& p : points)
        nearest2 = std::min(nearest2, (p - point).squaredNorm());
    return std::sqrt(nearest2);
}

}  // namespace camdir::test
