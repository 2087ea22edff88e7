#include "freespace/slab.hpp"

#include <algorithm>

#include "freespace/lanes.hpp"

namespace camdir::freespace {
namespace {

struct Lanes3 {
    Lanes x, y, z;
};

Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Lanes3 operator*(Lanes s, const Lanes3& a) {
    return {s * a.x, s * a.y, s * a.z};
}
Lanes dot(const Lanes3& a, const Lanes3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Lanes norm(const Lanes3& a) {
    return square_root(dot(a, a));
}

// A corner of four triangles, relative to the query point, which keeps the arithmetic precise far from the
// origin.
struct Corners {
    Lanes3 position;
    Lanes radius;
};

// Four points of four slabs.
struct Points {
    Lanes value, u, v;
};

Corners gather(std::span<const Vertex> vertices, const std::uint32_t (&corner)[lane_count],
               const Lanes3& point) {
    Lanes x = load(&vertices[corner[0]].x);
    Lanes y = load(&vertices[corner[1]].x);
    Lanes z = load(&vertices[corner[2]].x);
    Lanes radius = load(&vertices[corner[3]].x);
    transpose(x, y, z, radius);
    return {Lanes3{x, y, z} - point, radius};
}

// The maximum over the triangle's plane where it exists and lies inside, else -infinity.
Points best_inside(const Corners& a, const Lanes3& ab, const Lanes3& ac, Lanes rise_b, Lanes rise_c) {
    const Lanes bb = dot(ab, ab);
    const Lanes bc = dot(ab, ac);
    const Lanes cc = dot(ac, ac);
    const Lanes inverse = 1.0F / (bb * cc - bc * bc);
    // The gradient of r and the foot of the query point in the triangle's own coordinates.
    const Lanes gradient_u = (cc * rise_b - bc * rise_c) * inverse;
    const Lanes gradient_v = (bb * rise_c - bc * rise_b) * inverse;
    const Lanes down_b = -dot(a.position, ab);
    const Lanes down_c = -dot(a.position, ac);
    const Lanes foot_u = (cc * down_b - bc * down_c) * inverse;
    const Lanes foot_v = (bb * down_c - bc * down_b) * inverse;
    const Lanes3 foot = a.position + foot_u * ab + foot_v * ac;
    const Lanes flatness = 1.0F - (gradient_u * rise_b + gradient_v * rise_c);  // 1 - g^2
    const Lanes uphill = square_root(dot(foot, foot) / flatness);
    const Lanes u = foot_u + uphill * gradient_u;
    const Lanes v = foot_v + uphill * gradient_v;
    const Lanes value = a.radius + u * rise_b + v * rise_c - norm(a.position + u * ab + v * ac);
    const LaneMask inside = (flatness > 0.0F) & (u >= 0.0F) & (v >= 0.0F) & (u + v <= 1.0F);
    return {inside ? value : broadcast(-std::numeric_limits<float>::infinity()), u, v};
}

struct EdgePoints {
    Lanes value, t;
};

// The best point of the edges from `a` along `edge`, on which r rises by `rise`.
EdgePoints best_on_edge(const Corners& a, const Lanes3& edge, Lanes rise) {
    const Lanes zero{};
    const Lanes length2 = dot(edge, edge);
    const Lanes foot_t = -dot(a.position, edge) / length2;
    const Lanes3 foot = a.position + foot_t * edge;
    const Lanes flatness = length2 - rise * rise;  // (1 - slope^2) length^2
    const Lanes uphill = rise * square_root(dot(foot, foot) / (length2 * flatness));
    // Steeper than 1: the ball at the higher end holds all the others.
    const Lanes steep = rise > zero ? zero + 1.0F : zero;
    const Lanes t = smaller(larger(flatness > zero ? foot_t + uphill : steep, zero), zero + 1.0F);
    return {a.radius + t * rise - norm(a.position + t * edge), t};
}

void keep_larger(Points& best, const Points& other) {
    const LaneMask better = other.value > best.value;
    best = {better ? other.value : best.value, better ? other.u : best.u, better ? other.v : best.v};
}

Points best_points(const MeshView& mesh, const Lanes3& point, const std::uint32_t (&triangle)[lane_count]) {
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
    const Lanes3 ab = b.position - a.position;
    const Lanes3 ac = c.position - a.position;
    const Lanes rise_b = b.radius - a.radius;
    const Lanes rise_c = c.radius - a.radius;

    const Lanes zero{};
    Points best = best_inside(a, ab, ac, rise_b, rise_c);
    const EdgePoints on_ab = best_on_edge(a, ab, rise_b);
    keep_larger(best, {on_ab.value, on_ab.t, zero});
    const EdgePoints on_ac = best_on_edge(a, ac, rise_c);
    keep_larger(best, {on_ac.value, zero, on_ac.t});
    const EdgePoints on_bc = best_on_edge(b, c.position - b.position, c.radius - b.radius);
    keep_larger(best, {on_bc.value, 1.0F - on_bc.t, on_bc.t});
    return best;
}

Lanes3 spread(const Vec3f& point) {
    return {broadcast(point.x()), broadcast(point.y()), broadcast(point.z())};
}

void improve_four(const MeshView& mesh, const Lanes3& point, const std::uint32_t (&triangle)[lane_count],
                  SlabPoint& best) {
    const Points points = best_points(mesh, point, triangle);
    if (bits(points.value > best.value) == 0) return;
    for (int k = 0; k < lane_count; ++k)
        if (points.value[k] > best.value) best = {points.value[k], triangle[k], points.u[k], points.v[k]};
}

}  // namespace

void improve(const MeshView& mesh, const Vec3f& point, std::span<const std::uint32_t> triangles,
             SlabPoint& best) {
    const Lanes3 lanes = spread(point);
    for (std::size_t i = 0; i < triangles.size(); i += lane_count) {
        std::uint32_t four[lane_count];
        for (std::size_t k = 0; k < lane_count; ++k)
            four[k] = triangles[std::min(i + k, triangles.size() - 1)];
        improve_four(mesh, lanes, four, best);
    }
}

void improve_range(const MeshView& mesh, const Vec3f& point, std::uint32_t first, std::uint32_t count,
                   SlabPoint& best) {
    const Lanes3 lanes = spread(point);
    for (std::uint32_t i = 0; i < count; i += lane_count) {
        std::uint32_t four[lane_count];
        for (std::uint32_t k = 0; k < lane_count; ++k)
            four[k] = first + std::min(i + k, count - 1);
        improve_four(mesh, lanes, four, best);
    }
}

Ball ball_at(const MeshView& mesh, const SlabPoint& point) {
    const Triangle& triangle = mesh.triangles[point.triangle];
    const Vertex& a = mesh.vertices[triangle.a];
    const Vertex& b = mesh.vertices[triangle.b];
    const Vertex& c = mesh.vertices[triangle.c];
    // u + v may exceed 1 by a rounding.
    const double scale = std::max(1.0, static_cast<double>(point.u) + point.v);
    const double u = point.u / scale;
    const double v = point.v / scale;
    const double w = std::max(0.0, 1.0 - u - v);
    return {
        w * a.position().cast<double>() + u * b.position().cast<double>() + v * c.position().cast<double>(),
        w * a.free_distance + u * b.free_distance + v * c.free_distance};
}

}  // namespace camdir::freespace
