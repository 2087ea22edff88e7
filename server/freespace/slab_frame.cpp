#include "freespace/slab_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace camdir::freespace {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

// ---- The frames ----

// Steeper than 1 the ball at the higher end holds all the others: uphill without bound.
constexpr double steep = 1e30;
// A triangle flatter than this, or on which the free distance is nearly that steep, is searched by its edges.
constexpr double least_height = 1e-6;
constexpr double least_fall2 = 1e-6;

// ab the longest edge and ac the shortest, so that no edge is the small difference of large coordinates.
Triangle by_length_of_edges(std::span<const Vertex> vertices, const Triangle& triangle) {
    auto [a, b, c] = triangle;
    const auto length2 = [&](std::uint32_t from, std::uint32_t to) {
        return (vertices[to].position().cast<double>() - vertices[from].position().cast<double>())
            .squaredNorm();
    };
    if (length2(a, b) < length2(b, c)) std::swap(a, c);
    if (length2(a, b) < length2(a, c)) std::swap(b, c);
    if (length2(b, c) < length2(a, c)) std::swap(a, b);
    return {a, b, c};
}

double uphill_of(double length2, double rise) {
    const double flatness = length2 - rise * rise;
    if (flatness <= 0.0) return rise > 0.0 ? steep : -steep;
    return rise / std::sqrt(length2 * flatness);
}

struct Edge {
    float uphill = 0.0F;
    float inverse_length2 = unbounded;

    Edge(const Vec3d& span, double rise) {
        const double length2 = span.squaredNorm();
        if (!(length2 > 1e-30)) return;
        uphill = static_cast<float>(std::clamp(uphill_of(length2, rise), -steep, steep));
        inverse_length2 = static_cast<float>(1.0 / length2);
    }
};

// A triangle that is a point, but for rounding: the largest ball stands for all.
SlabFrame point_frame(const Vertex& vertex) {
    return {.origin = {vertex.x, vertex.y, vertex.z},
            .radius_a = vertex.free_distance,
            .along = {1.0F, 0.0F, 0.0F},
            .length = 0.0F,
            .normal = {0.0F, 0.0F, 1.0F},
            .c_x = 0.0F,
            .c_y = 0.0F,
            .gradient_x = 0.0F,
            .gradient_y = 0.0F,
            .fall = unbounded,
            .inverse_fall = 0.0F,
            .uphill_ab = 0.0F,
            .uphill_ac = 0.0F,
            .uphill_bc = 0.0F,
            .rise_ac = 0.0F,
            .rise_bc = 0.0F,
            .inverse_ac2 = unbounded,
            .inverse_bc2 = unbounded};
}

void set(float (&row)[3], const Vec3d& vector) {
    for (int axis = 0; axis < 3; ++axis)
        row[axis] = static_cast<float>(vector[axis]);
}

SlabFrame make_frame(const Vertex& a, const Vertex& b, const Vertex& c) {
    const Vec3d ab = b.position().cast<double>() - a.position().cast<double>();
    const Vec3d ac = c.position().cast<double>() - a.position().cast<double>();
    const double rise_ab = double{b.free_distance} - a.free_distance;
    const double rise_ac = double{c.free_distance} - a.free_distance;
    const double length = ab.norm();
    const Vec3d along = ab / length;
    const double c_x = along.dot(ac);
    const Vec3d side = along.cross(ac);
    const double c_y = side.norm();
    const double slope = rise_ab / length;
    const bool has_interior = c_y > least_height * length;
    const double gradient_y = has_interior ? (rise_ac - slope * c_x) / c_y : 0.0;
    const double fall2 = 1.0 - slope * slope - gradient_y * gradient_y;
    const bool is_searched = has_interior && fall2 > least_fall2;

    SlabFrame frame = point_frame(a);
    set(frame.along, along);
    set(frame.normal, c_y > 0.0 ? Vec3d(side / c_y) : Vec3d(along.unitOrthogonal()));
    frame.length = static_cast<float>(length);
    frame.c_x = static_cast<float>(c_x);
    frame.c_y = static_cast<float>(c_y);
    frame.gradient_x = static_cast<float>(slope);
    if (is_searched) {
        frame.gradient_y = static_cast<float>(gradient_y);
        frame.fall = static_cast<float>(std::sqrt(fall2));
        frame.inverse_fall = static_cast<float>(1.0 / std::sqrt(fall2));
    }
    const Edge edge_ab(ab, rise_ab);
    const Edge edge_ac(ac, rise_ac);
    const Edge edge_bc(ac - ab, rise_ac - rise_ab);
    frame.uphill_ab = static_cast<float>(std::clamp(edge_ab.uphill * length, -steep, steep));
    frame.uphill_ac = edge_ac.uphill;
    frame.uphill_bc = edge_bc.uphill;
    frame.rise_ac = static_cast<float>(rise_ac);
    frame.rise_bc = static_cast<float>(rise_ac - rise_ab);
    frame.inverse_ac2 = edge_ac.inverse_length2;
    frame.inverse_bc2 = edge_bc.inverse_length2;
    return frame;
}

// Without an edge whose slope a float could hold.
bool is_point(const Vertex& a, const Vertex& b, const Vertex& c) {
    const double length = (b.position().cast<double>() - a.position().cast<double>()).norm();
    const double rise = std::max(std::abs(double{b.free_distance} - a.free_distance),
                                 std::abs(double{c.free_distance} - a.free_distance));
    return !(length > 1e-12) || rise > 1e10 * length;
}

}  // namespace

SlabFrames build_frames(std::span<const Vertex> vertices, std::span<const Triangle> triangles) {
    SlabFrames made;
    made.frames.reserve(triangles.size());
    made.corners.reserve(triangles.size());
    for (const Triangle& triangle : triangles) {
        auto [a, b, c] = by_length_of_edges(vertices, triangle);
        const bool point = is_point(vertices[a], vertices[b], vertices[c]);
        if (point && vertices[b].free_distance > vertices[a].free_distance) std::swap(a, b);
        if (point && vertices[c].free_distance > vertices[a].free_distance) std::swap(a, c);
        made.corners.push_back({a, b, c});
        made.frames.push_back(point ? point_frame(vertices[a])
                                    : make_frame(vertices[a], vertices[b], vertices[c]));
    }
    return made;
}

}  // namespace camdir::freespace
