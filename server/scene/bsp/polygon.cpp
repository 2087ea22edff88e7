#include "scene/bsp/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace camdir::scene {
namespace {

double height_above(const Plane& plane, const Vec3d& point) {
    return plane.normal.dot(point) - plane.distance;
}

}  // namespace

Plane normalized(const Plane& plane) {
    const double length = plane.normal.norm();
    return {plane.normal / length, plane.distance / length};
}

Plane flipped(const Plane& plane) {
    return {-plane.normal, -plane.distance};
}

Polygon base_winding(const Plane& plane, double half_side) {
    Eigen::Index thinnest = 0;
    plane.normal.cwiseAbs().minCoeff(&thinnest);
    const Vec3d u = plane.normal.cross(Vec3d::Unit(thinnest)).normalized() * half_side;
    const Vec3d v = plane.normal.cross(u);
    const Vec3d centre = plane.normal * plane.distance;
    return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

bool lies_on(const Polygon& polygon, const Plane& plane, double tolerance) {
    return std::all_of(polygon.begin(), polygon.end(),
                       [&](const Vec3d& p) { return std::abs(height_above(plane, p)) <= tolerance; });
}

Polygon clip(const Polygon& polygon, const Plane& plane, double tolerance) {
    Polygon behind;
    bool has_volume = false;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d& here = polygon[i];
        const Vec3d& next = polygon[(i + 1) % polygon.size()];
        const double height = height_above(plane, here);
        const double next_height = height_above(plane, next);
        if (height <= tolerance) behind.push_back(here);
        if (height < -tolerance) has_volume = true;
        const bool crosses = (height > tolerance && next_height < -tolerance) ||
                             (height < -tolerance && next_height > tolerance);
        if (crosses) behind.push_back(here + (next - here) * (height / (height - next_height)));
    }
    if (!has_volume || behind.size() < 3) behind.clear();
    return behind;
}

Polygon clip_to_box(Polygon polygon, const Box3d& box) {
    for (Eigen::Index axis = 0; axis < 3 && !polygon.empty(); ++axis) {
        const Vec3d up = Vec3d::Unit(axis);
        polygon = clip(polygon, Plane{up, box.max()[axis]}, 0.0);
        polygon = clip(polygon, Plane{-up, -box.min()[axis]}, 0.0);
    }
    return polygon;
}

std::vector<std::array<std::size_t, 3>> triangulate(const Polygon& polygon) {
    std::vector<std::array<std::size_t, 3>> triangles;
    if (polygon.size() < 3) return triangles;
    std::size_t left = 0;
    std::size_t right = polygon.size() - 1;
    while (right - left >= 2) {
        const double from_left = (polygon[left + 1] - polygon[right]).squaredNorm();
        const double from_right = (polygon[left] - polygon[right - 1]).squaredNorm();
        if (from_left <= from_right) {
            triangles.push_back({left, left + 1, right});
            ++left;
        } else {
            triangles.push_back({left, right - 1, right});
            --right;
        }
    }
    return triangles;
}

}  // namespace camdir::scene
