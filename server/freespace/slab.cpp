#include "freespace/slab.hpp"

#include <algorithm>

#include "base/float4.hpp"

namespace camdir::freespace {
namespace {

struct Vec3x4 {
    Float4 x, y, z;
};

Vec3x4 operator+(const Vec3x4& a, const Vec3x4& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Vec3x4 operator-(const Vec3x4& a, const Vec3x4& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vec3x4 operator*(Float4 s, const Vec3x4& a) {
    return {s * a.x, s * a.y, s * a.z};
}
Float4 dot(const Vec3x4& a, const Vec3x4& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Float4 norm(const Vec3x4& a) {
    return square_root(dot(a, a));
}

// A corner of four triangles, relative to the query point, which keeps the arithmetic precise far from the
// origin.
struct Corners {
    Vec3x4 position;
    Float4 radius;
};

// Four points of four slabs.
struct Points {
    Float4 value, u, v;
};

Corners gather(std::span<const Vertex> vertices, const std::uint32_t (&corner)[lane_count],
               const Vec3x4& point) {
    Float4 x = load(&vertices[corner[0]].x);
    Float4 y = load(&vertices[corner[1]].x);
    Float4 z = load(&vertices[corner[2]].x);
    Float4 radius = load(&vertices[corner[3]].x);
    transpose(x, y, z, radius);
    return {Vec3x4{x, y, z} - point, radius};
}

// The maximum over the triangle's plane if it exists and lies in the triangle; else -infinity.
Points best_inside(const Corners& a, const Vec3x4& ab, const Vec3x4& ac, Float4 rise_b, Float4 rise_c) {
    const Float4 bb = dot(ab, ab);
    const Float4 bc = dot(ab, ac);
    const Float4 cc = dot(ac, ac);
    const Float4 inverse = 1.0F / (bb * cc - bc * bc);
    // The gradient of r and the foot of the query point in the triangle's own coordinates.
    const Float4 gradient_u = (cc * rise_b - bc * rise_c) * inverse;
    const Float4 gradient_v = (bb * rise_c - bc * rise_b) * inverse;
    const Float4 down_b = -dot(a.position, ab);
    const Float4 down_c = -dot(a.position, ac);
    const Float4 foot_u = (cc * down_b - bc * down_c) * inverse;
    const Float4 foot_v = (bb * down_c - bc * down_b) * inverse;
    const Vec3x4 foot = a.position + foot_u * ab + foot_v * ac;
    const Float4 flatness = 1.0F - (gradient_u * rise_b + gradient_v * rise_c);  // 1 - g^2
    const Float4 uphill = square_root(dot(foot, foot) / flatness);
    const Float4 u = foot_u + uphill * gradient_u;
    const Float4 v = foot_v + uphill * gradient_v;
    const Float4 value = a.radius + u * rise_b + v * rise_c - norm(a.position + u * ab + v * ac);
    const Mask4 inside = (flatness > 0.0F) & (u >= 0.0F) & (v >= 0.0F) & (u + v <= 1.0F);
    return {inside ? value : broadcast(-std::numeric_limits<float>::infinity()), u, v};
}

struct EdgePoints {
    Float4 value, t;
};

// The best point of the edges from `a` along `edge`, on which r rises by `rise`.
EdgePoints best_on_edge(const Corners& a, const Vec3x4& edge, Float4 rise) {
    const Float4 zero{};
    const Float4 length2 = dot(edge, edge);
    const Float4 foot_t = -dot(a.position, edge) / length2;
    const Vec3x4 foot = a.position + foot_t * edge;
    const Float4 flatness = length2 - rise * rise;  // (1 - slope^2) length^2
    const Float4 uphill = rise * square_root(dot(foot, foot) / (length2 * flatness));
    // Steeper than 1: the ball at the higher end holds all the others.
    const Float4 steep = rise > zero ? zero + 1.0F : zero;
    const Float4 t = smaller(larger(flatness > zero ? foot_t + uphill : steep, zero), zero + 1.0F);
    return {a.radius + t * rise - norm(a.position + t * edge), t};
}

void keep_larger(Points& best, const Points& other) {
    const Mask4 better = other.value > best.value;
    best = {better ? other.value : best.value, better ? other.u : best.u, better ? other.v : best.v};
}

Points best_points(const MeshView& mesh, const Vec3x4& point, const std::uint32_t (&triangle)[lane_count]) {
    std::uint32_t corner[3][lane_count];
    for (int k = 0; k < lane_count; ++k) {
        const Triangle& t = mesh.triangles[triangle[k]];
        corner[0][k] = t.a;
        corner[1][k] = t.b;
        corner[2][k] = t.c;
    }
    const Corners a = gather(mesh.vertices, corner[0], point);
    const Corners b = gather(mesh.vertices, corner[1], point);
    const Corners c = gather(mesh.vertices, corner[2], point);
    const Vec3x4 ab = b.position - a.position;
    const Vec3x4 ac = c.position - a.position;
    const Float4 rise_b = b.radius - a.radius;
    const Float4 rise_c = c.radius - a.radius;

    const Float4 zero{};
    Points best = best_inside(a, ab, ac, rise_b, rise_c);
    const EdgePoints on_ab = best_on_edge(a, ab, rise_b);
    keep_larger(best, {on_ab.value, on_ab.t, zero});
    const EdgePoints on_ac = best_on_edge(a, ac, rise_c);
    keep_larger(best, {on_ac.value, zero, on_ac.t});
    const EdgePoints on_bc = best_on_edge(b, c.position - b.position, c.radius - b.radius);
    keep_larger(best, {on_bc.value, 1.0F - on_bc.t, on_bc.t});
    return best;
}

Vec3x4 in_all_lanes(const Vec3f& point) {
    return {broadcast(point.x()), broadcast(point.y()), broadcast(point.z())};
}

void improve_four(const MeshView& mesh, const Vec3x4& point, const std::uint32_t (&triangle)[lane_count],
                  SlabPoint& best) {
    const Points points = best_points(mesh, point, triangle);
    if (bits(points.value > best.value) == 0) return;
    for (int k = 0; k < lane_count; ++k)
        if (points.value[k] > best.value) best = {points.value[k], triangle[k], points.u[k], points.v[k]};
}

}  // namespace

void improve_range(const MeshView& mesh, const Vec3f& point, std::uint32_t first, std::uint32_t count,
                   SlabPoint& best) {
    const Vec3x4 points = in_all_lanes(point);
    for (std::uint32_t i = 0; i < count; i += lane_count) {
        std::uint32_t four[lane_count];
        for (std::uint32_t k = 0; k < lane_count; ++k)
            four[k] = first + std::min(i + k, count - 1);
        improve_four(mesh, points, four, best);
    }
}

Ball ball_at(const MeshView& mesh, const SlabPoint& point) {
    return ball_at(mesh.vertices, mesh.triangles[point.triangle], point);
}

Ball ball_at(std::span<const Vertex> vertices, const Triangle& corners, const SlabPoint& point) {
    const Vertex& a = vertices[corners.a];
    const Vertex& b = vertices[corners.b];
    const Vertex& c = vertices[corners.c];
    // Rounding may have left u or v below 0, or their sum above 1.
    const double sum = std::max(point.u, 0.0F) + double{std::max(point.v, 0.0F)};
    const double scale = std::max(1.0, sum);
    const double u = std::max(point.u, 0.0F) / scale;
    const double v = std::max(point.v, 0.0F) / scale;
    const double w = std::max(0.0, 1.0 - u - v);
    return {
        w * a.position().cast<double>() + u * b.position().cast<double>() + v * c.position().cast<double>(),
        w * a.free_distance + u * b.free_distance + v * c.free_distance};
}

}  // namespace camdir::freespace
