#include "bake/certificate.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::bake {
namespace {

void take_smaller(Margin& best, const Margin& other) {
    if (other.value < best.value) best = other;
}

// Barycentric coordinates of the point at `t` of the edge from corner `edge` to the next one.
std::array<double, 3> on_edge(int edge, double t) {
    std::array<double, 3> weights{};
    weights[edge] = 1.0 - t;
    weights[(edge + 1) % 3] = t;
    return weights;
}

// Where the segment a-b meets the triangle: the parameter on the segment and the weights in the triangle.
struct Crossing {
    bool found = false;
    double t = 0.0;
    std::array<double, 3> weights{};
};

Crossing cross(const Vec3d& a, const Vec3d& b, const Triangle3d& triangle) {
    const Vec3d along = b - a;
    const Vec3d u = triangle[1] - triangle[0];
    const Vec3d v = triangle[2] - triangle[0];
    const Vec3d normal = u.cross(v);
    const double slope = along.dot(normal);
    const double t = (triangle[0] - a).dot(normal) / slope;
    if (!(t >= 0.0 && t <= 1.0)) return {};
    const Vec3d p = a + t * along - triangle[0];
    const double area2 = normal.squaredNorm();
    const double weight_v = u.cross(p).dot(normal) / area2;
    const double weight_u = p.cross(v).dot(normal) / area2;
    if (!(weight_u >= 0.0 && weight_v >= 0.0 && weight_u + weight_v <= 1.0)) return {};
    return {true, t, {1.0 - weight_u - weight_v, weight_u, weight_v}};
}

}  // namespace

Slab::Slab(const Triangle3d& corners, const std::array<double, 3>& free_distance)
    : corners_(corners),
      free_distance_(free_distance),
      middle_((corners[0] + corners[1] + corners[2]) / 3.0) {
    const Vec3d u = corners[1] - corners[0];
    const Vec3d v = corners[2] - corners[0];
    normal_ = u.cross(v);
    area2_ = normal_.squaredNorm();
    // The gradient of r in the triangle's plane.
    const double du = free_distance[1] - free_distance[0];
    const double dv = free_distance[2] - free_distance[0];
    const Vec3d gradient = (du * v.cross(normal_) + dv * normal_.cross(u)) / area2_;
    const double slope2 = gradient.squaredNorm();
    steep_ = !(slope2 < 1.0);
    incline_ = steep_ ? Vec3d::Zero() : Vec3d(gradient / std::sqrt(1.0 - slope2));
}

Margin Slab::at(const std::array<double, 3>& weights, const Vec3d& q) const {
    const Vec3d m = weights[0] * corners_[0] + weights[1] * corners_[1] + weights[2] * corners_[2];
    const double r =
        weights[0] * free_distance_[0] + weights[1] * free_distance_[1] + weights[2] * free_distance_[2];
    return {(m - q).norm() - r, weights};
}

double Slab::reach(const Vec3d& direction, std::size_t corner) const {
    return direction.dot(corners_[corner]) + free_distance_[corner];
}

std::size_t Slab::farthest(const Vec3d& direction) const {
    const std::size_t corner = reach(direction, 1) > reach(direction, 0) ? 1 : 0;
    return reach(direction, 2) > reach(direction, corner) ? 2 : corner;
}

double Slab::reach(const Vec3d& direction) const {
    return std::max({reach(direction, 0), reach(direction, 1), reach(direction, 2)});
}

double Slab::margin_at_least(const Box3d& box) const {
    const Vec3d nearest = middle_.cwiseMax(box.min()).cwiseMin(box.max());
    const Vec3d to_box = nearest - middle_;
    const double distance = to_box.norm();
    if (!(distance > 0.0)) return -std::numeric_limits<double>::infinity();
    const Vec3d direction = to_box / distance;
    // The nearest point of a box to a point outside is also its lowest along the direction to it.
    return direction.dot(nearest) - reach(direction);
}

double Slab::margin_at_least_by_plane(const Triangle3d& obstacle) const {
    const Vec3d normal = (obstacle[1] - obstacle[0]).cross(obstacle[2] - obstacle[0]);
    const double length = normal.norm();
    const double side = normal.dot(middle_ - obstacle[0]);
    if (!(length > 0.0)) return -std::numeric_limits<double>::infinity();
    const Vec3d direction = normal / (side < 0.0 ? length : -length);
    return direction.dot(obstacle[0]) - reach(direction);
}

// Walks from the middle towards the m of the smallest margin, in the manner of Frank and Wolfe: the direction
// to the nearest point of the obstacle separates the two, or else the slab reaches farthest along it at one
// of its corners, and the walk goes there. Three of four obstacles that the middle's own direction leaves are
// told apart so at a fraction of what the margin costs.
double Slab::margin_at_least(const Triangle3d& obstacle) const {
    constexpr int max_steps = 8;
    constexpr double stride = 0.4;
    double bound = margin_at_least_by_plane(obstacle);
    Vec3d m = middle_;
    double r = (free_distance_[0] + free_distance_[1] + free_distance_[2]) / 3.0;
    for (int step = 0; step < max_steps && bound < 0.0; ++step) {
        const Vec3d to_obstacle = closest_point(obstacle, m) - m;
        const double distance = to_obstacle.norm();
        if (!(distance > std::max(r, 0.0))) break;  // nothing separates them
        const Vec3d direction = to_obstacle / distance;
        const double lowest =
            std::min({direction.dot(obstacle[0]), direction.dot(obstacle[1]), direction.dot(obstacle[2])});
        const std::size_t corner = farthest(direction);
        bound = std::max(bound, lowest - reach(direction, corner));
        m += stride * (corners_[corner] - m);
        r += stride * (free_distance_[corner] - r);
    }
    return bound;
}

Margin Slab::from_edge_to_point(int edge, const Vec3d& q) const {
    const Vec3d& a = corners_[edge];
    const Vec3d along = corners_[(edge + 1) % 3] - a;
    const double rise = free_distance_[(edge + 1) % 3] - free_distance_[edge];
    const double length2 = along.squaredNorm();
    const double flat2 = length2 - rise * rise;
    double t = rise > 0.0 ? 1.0 : 0.0;
    if (flat2 > 0.0) {
        const double foot = along.dot(q - a) / length2;
        const double height2 = std::max(0.0, (q - a).squaredNorm() - foot * foot * length2);
        t = std::clamp(foot + rise * std::sqrt(height2 / flat2) / std::sqrt(length2), 0.0, 1.0);
    }
    return at(on_edge(edge, t), q);
}

Margin Slab::towards_point(const Vec3d& q) const {
    if (!steep_ && area2_ > 0.0) {
        const double height = std::abs((q - corners_[0]).dot(normal_)) / std::sqrt(area2_);
        const Vec3d m = q + height * incline_ - corners_[0];  // its foot in the plane is the best m
        const Vec3d u = corners_[1] - corners_[0];
        const Vec3d v = corners_[2] - corners_[0];
        const double weight_u = m.cross(v).dot(normal_) / area2_;
        const double weight_v = u.cross(m).dot(normal_) / area2_;
        const double weight_0 = 1.0 - weight_u - weight_v;
        if (weight_u >= 0.0 && weight_v >= 0.0 && weight_0 >= 0.0)
            return at({weight_0, weight_u, weight_v}, q);
    }
    Margin best = from_edge_to_point(0, q);
    take_smaller(best, from_edge_to_point(1, q));
    take_smaller(best, from_edge_to_point(2, q));
    return best;
}

// Only inner points of both edges: their ends belong to from_corner and towards_point.
Margin Slab::from_edge_to_edge(int edge, const Vec3d& a, const Vec3d& b) const {
    const Vec3d& p = corners_[edge];
    const Vec3d along = corners_[(edge + 1) % 3] - p;
    const double rise = free_distance_[(edge + 1) % 3] - free_distance_[edge];
    const Vec3d other = b - a;
    const double other2 = other.squaredNorm();
    // The part of the slab's edge across the other one, where the two lines approach each other.
    const Vec3d across = along - other * (along.dot(other) / other2);
    const double across2 = across.squaredNorm();
    if (!(across2 > rise * rise)) return {};
    const Vec3d between = a - p;
    const Vec3d normal = along.cross(other);
    const double height2 = std::pow(between.dot(normal), 2) / normal.squaredNorm();
    const double meeting = between.dot(across) / across2;
    const double s = meeting + rise * std::sqrt(height2 / (across2 - rise * rise)) / std::sqrt(across2);
    if (!(s > 0.0 && s < 1.0)) return {};
    const double t = (p + s * along - a).dot(other) / other2;
    if (!(t > 0.0 && t < 1.0)) return {};
    return at(on_edge(edge, s), a + t * other);
}

Margin Slab::from_corner(int corner, const Triangle3d& obstacle) const {
    std::array<double, 3> weights{};
    weights[corner] = 1.0;
    return at(weights, closest_point(obstacle, corners_[corner]));
}

// Where the triangles cross, the distance is 0 on a segment, and r is largest at one of its ends.
Margin Slab::where_crossing(const Triangle3d& obstacle) const {
    Margin best;
    const auto consider = [&](const std::array<double, 3>& weights) {
        const double r =
            weights[0] * free_distance_[0] + weights[1] * free_distance_[1] + weights[2] * free_distance_[2];
        take_smaller(best, {-r, weights});
    };
    for (int i = 0; i < 3; ++i) {
        const Crossing edge = cross(corners_[i], corners_[(i + 1) % 3], obstacle);
        if (edge.found) consider(on_edge(i, edge.t));
        const Crossing face = cross(obstacle[i], obstacle[(i + 1) % 3], corners_);
        if (face.found) consider(face.weights);
    }
    return best;
}

// The function is convex in m and q together, so unless the triangles cross, the optimum is attained where
// one of the two points is a corner or both lie on edges.
Margin Slab::margin(const Triangle3d& obstacle) const {
    Margin best = where_crossing(obstacle);
    for (int i = 0; i < 3; ++i) {
        take_smaller(best, towards_point(obstacle[i]));
        take_smaller(best, from_corner(i, obstacle));
        for (int edge = 0; edge < 3; ++edge)
            take_smaller(best, from_edge_to_edge(edge, obstacle[i], obstacle[(i + 1) % 3]));
    }
    return best;
}

Margin margin(const Slab& slab, const Obstacles& obstacles, double enough) {
    Margin worst{enough, {}};
    obstacles.tree().visit_by([&](const Box3d& box) { return slab.margin_at_least(box); },
                              [&] { return worst.value; },
                              [&](std::uint32_t position) {
                                  const Triangle3d& obstacle = obstacles.triangles()[position];
                                  if (slab.margin_at_least(obstacle) < worst.value)
                                      take_smaller(worst, slab.margin(obstacle));
                              });
    return worst;
}

std::uint32_t find_violated(const Slab& slab, const Obstacles& obstacles, std::uint32_t suspect) {
    const auto violates = [&](std::uint32_t position) {
        const Triangle3d& obstacle = obstacles.triangles()[position];
        return slab.margin_at_least(obstacle) < 0.0 && slab.margin(obstacle).value < 0.0;
    };
    if (suspect != freespace::none && violates(suspect)) return suspect;
    std::uint32_t found = freespace::none;
    obstacles.tree().visit_by(
        [&](const Box3d& box) { return slab.margin_at_least(box); },
        [&] { return found == freespace::none ? 0.0 : -std::numeric_limits<double>::infinity(); },
        [&](std::uint32_t position) {
            if (found == freespace::none && violates(position)) found = position;
        });
    return found;
}

bool is_certified(const Slab& slab, const Obstacles& obstacles) {
    return find_violated(slab, obstacles) == freespace::none;
}

}  // namespace camdir::bake
