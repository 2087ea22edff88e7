#include "bench/queries/embree_queries.hpp"

#include <embree3/rtcore.h>

#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace camdir::bench {
namespace {

RTCRay ray_between(const Vec3f& from, const Vec3f& to) {
    RTCRay ray{};
    ray.org_x = from.x();
    ray.org_y = from.y();
    ray.org_z = from.z();
    ray.dir_x = to.x() - from.x();
    ray.dir_y = to.y() - from.y();
    ray.dir_z = to.z() - from.z();
    ray.tnear = 0.0F;
    ray.tfar = 1.0F;
    ray.mask = 0xffffffffU;
    return ray;
}

// Occlusion sets tfar to -infinity.
bool is_clear(const RTCRay& ray) {
    return ray.tfar >= 0.0F;
}

// Ericson, Real-Time Collision Detection, 5.1.5.
Vec3f closest_on_triangle(const Vec3f& p, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
    const Vec3f ab = b - a;
    const Vec3f ac = c - a;
    const float d1 = ab.dot(p - a);
    const float d2 = ac.dot(p - a);
    if (d1 <= 0.0F && d2 <= 0.0F) return a;
    const float d3 = ab.dot(p - b);
    const float d4 = ac.dot(p - b);
    if (d3 >= 0.0F && d4 <= d3) return b;
    const float vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0F && d1 >= 0.0F && d3 <= 0.0F) return a + d1 / (d1 - d3) * ab;
    const float d5 = ab.dot(p - c);
    const float d6 = ac.dot(p - c);
    if (d6 >= 0.0F && d5 <= d6) return c;
    const float vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0F && d2 >= 0.0F && d6 <= 0.0F) return a + d2 / (d2 - d6) * ac;
    const float va = d3 * d6 - d5 * d4;
    if (va <= 0.0F && d4 >= d3 && d5 >= d6) return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    const float scale = 1.0F / (va + vb + vc);
    return a + vb * scale * ab + vc * scale * ac;
}

}  // namespace

struct EmbreeQueries::Handles {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = rtcNewScene(device);
    std::vector<Vec3f> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    Handles() = default;
    Handles(const Handles&) = delete;
    ~Handles() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }
};

EmbreeQueries::EmbreeQueries(const scene::Scene& scene) : handles_(std::make_unique<Handles>()) {
    handles_->triangles = scene.triangles;
    for (const Vec3d& vertex : scene.vertices)
        handles_->vertices.push_back(vertex.cast<float>());
    const RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Vec3f), handles_->vertices.size()));
    auto* indices =
        static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                       3 * sizeof(unsigned), handles_->triangles.size()));
    for (const Vec3f& vertex : handles_->vertices)
        for (int axis = 0; axis < 3; ++axis)
            *vertices++ = vertex[axis];
    for (const auto& triangle : handles_->triangles)
        for (const std::uint32_t corner : triangle)
            *indices++ = corner;
    rtcCommitGeometry(geometry);
    rtcSetSceneBuildQuality(handles_->scene, RTC_BUILD_QUALITY_HIGH);
    rtcAttachGeometry(handles_->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(handles_->scene);
}

EmbreeQueries::EmbreeQueries(EmbreeQueries&&) noexcept = default;
EmbreeQueries::~EmbreeQueries() = default;

bool EmbreeQueries::clear(const Vec3f& from, const Vec3f& to) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = ray_between(from, to);
    rtcOccluded1(handles_->scene, &context, &ray);
    return is_clear(ray);
}

float EmbreeQueries::cast(const Vec3f& from, const Vec3f& to) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit ray{};
    ray.ray = ray_between(from, to);
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(handles_->scene, &context, &ray);
    return ray.ray.tfar;
}

int EmbreeQueries::clear_of_bundle(const Vec3f& from, std::span<const Vec3f> to) const {
    std::array<RTCRay, 64> rays;
    assert(to.size() <= rays.size());
    for (std::size_t i = 0; i < to.size(); ++i)
        rays[i] = ray_between(from, to[i]);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcOccluded1M(handles_->scene, &context, rays.data(), static_cast<unsigned>(to.size()), sizeof(RTCRay));
    int clear = 0;
    for (std::size_t i = 0; i < to.size(); ++i)
        clear += is_clear(rays[i]) ? 1 : 0;
    return clear;
}

float EmbreeQueries::nearest(const Vec3f& point) const {
    RTCPointQuery query;
    query.x = point.x();
    query.y = point.y();
    query.z = point.z();
    query.radius = std::numeric_limits<float>::infinity();
    query.time = 0.0F;
    struct Call {
        const Handles& handles;
        Vec3f point;
    } call{*handles_, point};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(
        handles_->scene, &query, &context,
        [](RTCPointQueryFunctionArguments* arguments) {
            const Call& self = *static_cast<const Call*>(arguments->userPtr);
            const auto& [a, b, c] = self.handles.triangles[arguments->primID];
            const auto& v = self.handles.vertices;
            const float distance = (closest_on_triangle(self.point, v[a], v[b], v[c]) - self.point).norm();
            if (distance >= arguments->query->radius) return false;
            arguments->query->radius = distance;
            return true;
        },
        &call);
    return query.radius;
}

}  // namespace camdir::bench
