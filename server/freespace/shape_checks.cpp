#include "freespace/shape_checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::freespace {
namespace {

constexpr double parallel = 1e-9;   // squared sine of the angle between planes that have no common line
constexpr double min_slope = 3e-5;  // its root
constexpr double tolerance = 1e-4;  // of a corner's place in map units: floats of a thousand units have less
constexpr double farthest = 1e6;    // of a corner from the origin

struct Plane {
    Vec3d normal;
    double distance;
};

struct Line {
    Vec3d origin, direction;
};

std::optional<Line> common_line(const Plane& a, const Plane& b) {
    const Vec3d direction = a.normal.cross(b.normal);
    const double square = direction.squaredNorm();
    if (square < parallel) return std::nullopt;
    const Vec3d origin =
        (a.distance * b.normal.cross(direction) + b.distance * direction.cross(a.normal)) / square;
    return Line{origin, direction / std::sqrt(square)};
}

// The stretch of a line that is in a hull.
struct Stretch {
    double begin = -std::numeric_limits<double>::infinity();
    double end = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool is_empty() const { return begin > end + tolerance; }
    void cut(const Line& line, const Plane& plane) {
        const double slope = plane.normal.dot(line.direction);
        const double room = plane.distance - plane.normal.dot(line.origin);
        if (std::abs(slope) < min_slope) {
            if (room < -tolerance) begin = std::numeric_limits<double>::infinity();
        } else if (slope > 0.0) {
            end = std::min(end, room / slope);
        } else {
            begin = std::max(begin, room / slope);
        }
    }
};

}  // namespace

bool is_ball(const MoverBall& ball) {
    const float largest = std::max(ball.centre.cwiseAbs().maxCoeff(), ball.radius);
    return ball.centre.allFinite() && ball.radius > 0.0F && largest <= coordinate_limit;
}

// A bounded hull is as large as its edges, and an unbounded one has an edge without end, or no edges.
std::optional<Box3f> bounds_of(std::span<const HalfSpace> half_spaces) {
    if (half_spaces.size() < 4) return std::nullopt;
    std::vector<Plane> planes;
    for (const auto& [normal, distance] : half_spaces)
        planes.push_back({normal.cast<double>(), distance});
    Box3d bounds;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        for (std::size_t k = i + 1; k < planes.size(); ++k) {
            const auto line = common_line(planes[i], planes[k]);
            if (!line) continue;
            Stretch edge;
            for (std::size_t other = 0; other < planes.size() && !edge.is_empty(); ++other)
                if (other != i && other != k) edge.cut(*line, planes[other]);
            if (edge.is_empty()) continue;
            for (const double at : {edge.begin, edge.end}) {
                if (!std::isfinite(at)) return std::nullopt;
                const Vec3d corner = line->origin + at * line->direction;
                if (!(corner.cwiseAbs().maxCoeff() <= farthest)) return std::nullopt;
                bounds.extend(corner);
            }
        }
    }
    if (bounds.isEmpty()) return std::nullopt;
    const Vec3d margin =
        Vec3d::Constant(2.0 * tolerance) + 1e-6 * bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs());
    return Box3f((bounds.min() - margin).cast<float>(), (bounds.max() + margin).cast<float>());
}

}  // namespace camdir::freespace
