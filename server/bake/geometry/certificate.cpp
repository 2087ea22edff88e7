#include "bake/geometry/certificate.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::bake {
namespace {

void take_smaller(SignedGap& best, const SignedGap& other) {
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

struct Balls {
    std::vector<Vec3d> centres;
    std::vector<double> radii;
};

// Those at the corners; shared ones once.
Balls balls_of(std::span<const Slab> slabs) {
    Balls balls;
    const auto contain = [&](const Vec3d& centre, double radius) {
        for (std::size_t i = 0; i < balls.centres.size(); ++i)
            if (balls.centres[i] == centre && balls.radii[i] == radius) return true;
        return false;
    };
    for (const Slab& slab : slabs)
        for (std::size_t i = 0; i < 3; ++i) {
            if (contain(slab.corners()[i], slab.free_distance()[i])) continue;
            balls.centres.push_back(slab.corners()[i]);
            balls.radii.push_back(slab.free_distance()[i]);
        }
    return balls;
}

}  // namespace

Slab::Slab(const Triangle3d& corners, const std::array<double, 3>& free_distance)
    : corners_(corners), free_distance_(free_distance) {
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

SignedGap Slab::at(const std::array<double, 3>& weights, const Vec3d& q) const {
    const Vec3d m = weights[0] * corners_[0] + weights[1] * corners_[1] + weights[2] * corners_[2];
    const double r =
        weights[0] * free_distance_[0] + weights[1] * free_distance_[1] + weights[2] * free_distance_[2];
    return {(m - q).norm() - r, weights};
}

SignedGap Slab::from_edge_to_point(int edge, const Vec3d& q) const {
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

SignedGap Slab::towards_point(const Vec3d& q) const {
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
    SignedGap best = from_edge_to_point(0, q);
    take_smaller(best, from_edge_to_point(1, q));
    take_smaller(best, from_edge_to_point(2, q));
    return best;
}

// Only inner points of both edges: their ends belong to from_corner and towards_point.
SignedGap Slab::from_edge_to_edge(int edge, const Vec3d& a, const Vec3d& b) const {
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

SignedGap Slab::from_corner(int corner, const Triangle3d& obstacle) const {
    std::array<double, 3> weights{};
    weights[corner] = 1.0;
    return at(weights, closest_point(obstacle, corners_[corner]));
}

// Where the triangles cross, the distance is 0 on a segment, and r is largest at one of its ends.
SignedGap Slab::where_crossing(const Triangle3d& obstacle) const {
    SignedGap best;
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
SignedGap Slab::signed_gap(const Triangle3d& obstacle) const {
    SignedGap best = where_crossing(obstacle);
    for (int i = 0; i < 3; ++i) {
        take_smaller(best, towards_point(obstacle[i]));
        take_smaller(best, from_corner(i, obstacle));
        for (int edge = 0; edge < 3; ++edge)
            take_smaller(best, from_edge_to_edge(edge, obstacle[i], obstacle[(i + 1) % 3]));
    }
    return best;
}

SignedGap signed_gap(const Slab& slab, const Obstacles& obstacles, double enough) {
    SignedGap worst{enough, {}};
    obstacles.tree().visit_by([&](const Box3d& box) { return slab.min_gap(box); },
                              [&] { return worst.value; },
                              [&](std::uint32_t position) {
                                  const Triangle3d& obstacle = obstacles.triangles()[position];
                                  if (slab.min_gap(obstacle) < worst.value)
                                      take_smaller(worst, slab.signed_gap(obstacle));
                              });
    return worst;
}

std::uint32_t find_violated(std::span<const Slab> slabs, const Obstacles& obstacles, std::uint32_t hint) {
    if (slabs.empty()) return freespace::none;
    const auto violates = [&](std::uint32_t position) {
        const Triangle3d& obstacle = obstacles.triangles()[position];
        return std::any_of(slabs.begin(), slabs.end(), [&](const Slab& slab) {
            return slab.min_gap(obstacle) < 0.0 && slab.signed_gap(obstacle).value < 0.0;
        });
    };
    if (hint != freespace::none && violates(hint)) return hint;
    const Balls balls = balls_of(slabs);
    const BallHull<> hull(balls.centres, balls.radii);
    std::uint32_t found = freespace::none;
    obstacles.tree().visit_by(
        [&](const Box3d& box) { return hull.min_gap(box); },
        [&] { return found == freespace::none ? 0.0 : -std::numeric_limits<double>::infinity(); },
        [&](std::uint32_t position) {
            if (found != freespace::none) return;
            if (hull.min_gap(obstacles.triangles()[position]) < 0.0 && violates(position)) found = position;
        });
    return found;
}

bool is_certified(const Slab& slab, const Obstacles& obstacles) {
    return find_violated({&slab, 1}, obstacles) == freespace::none;
}

}  // namespace camdir::bake
