#include "oracle/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace camdir::oracle {
namespace {

RTCGeometry triangle_geometry(RTCDevice device, const scene::Scene& scene) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.vertices.size()));
    for (const Vec3d& vertex : scene.vertices) {
        for (const double coordinate : vertex) {
            *vertices++ = static_cast<float>(coordinate);
        }
    }
    auto* indices = static_cast<std::uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(std::uint32_t), scene.triangles.size()));
    for (const auto& triangle : scene.triangles) {
        indices = std::copy(triangle.begin(), triangle.end(), indices);
    }
    return geometry;
}

Vec3d closest_on_segment(const Vec3d& point, const Vec3d& a, const Vec3d& b) {
    const Vec3d along = b - a;
    const double length2 = along.squaredNorm();
    if (length2 == 0.0) return a;
    return a + along * std::clamp((point - a).dot(along) / length2, 0.0, 1.0);
}

}  // namespace

Vec3d closest_on_triangle(const Vec3d& point, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d normal = (b - a).cross(c - a);
    const auto is_inside = [&](const Vec3d& from, const Vec3d& to) {
        return normal.cross(to - from).dot(point - from) >= 0.0;
    };
    if (is_inside(a, b) && is_inside(b, c) && is_inside(c, a) && normal.squaredNorm() > 0.0)
        return point - normal * (normal.dot(point - a) / normal.squaredNorm());
    Vec3d closest = closest_on_segment(point, a, b);
    for (const Vec3d& other : {closest_on_segment(point, b, c), closest_on_segment(point, c, a)}) {
        if ((other - point).squaredNorm() < (closest - point).squaredNorm()) closest = other;
    }
    return closest;
}

Surfaces::Surfaces(RTCDevice device, const scene::Scene& scene)
    : vertices_(scene.vertices), triangles_(scene.triangles) {
    for (const Vec3d& vertex : vertices_) {
        rounding_ = std::max(rounding_, rounding_of(vertex.cwiseAbs().maxCoeff()));
    }
    if (!triangles_.empty()) scene_ = make_scene(device, triangle_geometry(device, scene));
}

Nearest Surfaces::nearest(const Vec3d& point, double limit) const {
    Nearest nearest{std::numeric_limits<double>::infinity(), Vec3d::Zero()};
    if (!scene_) return nearest;
    visit_near(scene_.get(), point, limit + rounding_, [&](unsigned triangle, double& radius) {
        const auto& [a, b, c] = triangles_[triangle];
        const Vec3d candidate = closest_on_triangle(point, vertices_[a], vertices_[b], vertices_[c]);
        const double distance = (candidate - point).norm();
        if (distance > limit || distance >= nearest.distance) return;
        nearest = {distance, candidate};
        radius = distance + rounding_;
    });
    return nearest;
}

bool Surfaces::end_clear(const Vec3d& end, double largest) const {
    const double hidden = rounding_ + rounding_of(largest);
    return nearest(end, hidden).distance > hidden;
}

bool Surfaces::between_clear(const Vec3d& from, const Vec3d& to) const {
    if (!scene_) return true;
    const Vec3d way = to - from;
    RTCRay ray{};
    ray.org_x = static_cast<float>(from.x());
    ray.org_y = static_cast<float>(from.y());
    ray.org_z = static_cast<float>(from.z());
    ray.dir_x = static_cast<float>(way.x());
    ray.dir_y = static_cast<float>(way.y());
    ray.dir_z = static_cast<float>(way.z());
    ray.tnear = 0.0F;
    ray.tfar = 1.0F;
    ray.mask = ~0U;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_.get(), &context, &ray);
    return ray.tfar >= 0.0F;
}

}  // namespace camdir::oracle
