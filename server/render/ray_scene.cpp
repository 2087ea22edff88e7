#include "render/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <new>
#include <span>

namespace camdir::render {
namespace {

// The input of a ray's filter.
struct Context {
    RTCIntersectContext embree;
    Vec3f seen_along;
    float top;
    bool cut_away;
};

Context context_of(const View& view, const Vec3f& seen_along) {
    Context context{{}, seen_along, static_cast<float>(view.top), view.cut_away};
    rtcInitIntersectContext(&context.embree);
    return context;
}

// Rejects hits that the view hides. The geometry's user data is set where back faces can be hidden.
void reject_hidden(const RTCFilterFunctionNArguments* arguments) {
    if (*arguments->valid == 0) return;
    const auto& context = *reinterpret_cast<const Context*>(arguments->context);
    const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    const float height = ray.org_z + ray.tfar * ray.dir_z;
    const bool shows_back = Vec3f(hit.Ng_x, hit.Ng_y, hit.Ng_z).dot(context.seen_along) > 0.0F;
    const bool has_backs = arguments->geometryUserPtr != nullptr;
    if (height > context.top || (context.cut_away && has_backs && shows_back)) *arguments->valid = 0;
}

template <class Value>
std::span<Value> new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    void* data = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Value), count);
    if (data == nullptr) throw std::bad_alloc();
    return {static_cast<Value*>(data), count};
}

using Point = std::array<float, 3>;
using RoundPoint = std::array<float, 4>;  // and its radius
using Corners = std::array<std::uint32_t, 3>;

Point point_of(const Vec3f& p) {
    return {p.x(), p.y(), p.z()};
}

RoundPoint round_point(const Vec3f& p, float radius) {
    return {p.x(), p.y(), p.z(), radius};
}

RTCRay ray_of(const Vec3f& origin, const Vec3f& direction, float from, float to) {
    RTCRay ray{};
    ray.org_x = origin.x();
    ray.org_y = origin.y();
    ray.org_z = origin.z();
    ray.dir_x = direction.x();
    ray.dir_y = direction.y();
    ray.dir_z = direction.z();
    ray.tnear = from;
    ray.tfar = to;
    ray.mask = ~0U;
    return ray;
}

}  // namespace

void RayScene::Release::operator()(RTCDeviceTy* device) const {
    rtcReleaseDevice(device);
}

void RayScene::Release::operator()(RTCSceneTy* scene) const {
    rtcReleaseScene(scene);
}

RayScene::RayScene(const Layers& layers, const View& view)
    : layers_(layers),
      view_(view),
      // Built by one thread: the same tree, thus the same choice between surfaces at one distance.
      device_(rtcNewDevice("threads=1")),
      all_(rtcNewScene(device_.get())),
      map_(rtcNewScene(device_.get())) {
    if (all_ == nullptr || map_ == nullptr) throw std::bad_alloc();
    if (layers.map != nullptr) add_map(*layers.map);
    if (layers.mesh != nullptr && layers.mesh_opacity > 0.0F) add_mesh(*layers.mesh);
    if (layers.mesh != nullptr && layers.roadmap_width > 0.0F) add_roadmap(*layers.mesh);
    for (std::uint32_t i = 0; i < layers.paths.size(); ++i)
        add_path(layers.paths[i], i);
    for (std::uint32_t i = 0; i < layers.balls.size(); ++i)
        add_balls(layers.balls[i].centres, layers.balls[i].radius, Hit::ball, i);
    rtcCommitScene(all_.get());
    rtcCommitScene(map_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) throw std::bad_alloc();
}

void RayScene::add(RTCGeometry geometry, Hit::Kind kind, std::uint32_t layer) {
    rtcSetGeometryIntersectFilterFunction(geometry, reject_hidden);
    rtcSetGeometryOccludedFilterFunction(geometry, reject_hidden);
    if (kind == Hit::map) rtcSetGeometryUserData(geometry, this);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(all_.get(), geometry);
    if (kind == Hit::map) rtcAttachGeometry(map_.get(), geometry);
    rtcReleaseGeometry(geometry);
    sources_.push_back({kind, layer});
}

void RayScene::add_map(const scene::Scene& scene) {
    if (!scene.points.empty()) {
        std::vector<Vec3f> points;
        for (const Vec3d& point : scene.points)
            points.push_back(point.cast<float>());
        return add_balls(points, layers_.map_point_radius, Hit::cloud, 0);
    }
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto points =
        new_buffer<Point>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, scene.vertices.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = point_of(scene.vertices[i].cast<float>());
    const auto corners =
        new_buffer<Corners>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, scene.triangles.size());
    std::copy(scene.triangles.begin(), scene.triangles.end(), corners.begin());
    add(geometry, Hit::map, 0);
}

void RayScene::add_mesh(const freespace::Freespace& mesh) {
    if (mesh.triangles().empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto points =
        new_buffer<Point>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices().size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = point_of(mesh.vertices()[i].position());
    const auto corners =
        new_buffer<Corners>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles().size());
    for (std::size_t i = 0; i < corners.size(); ++i)
        corners[i] = {mesh.triangles()[i].a, mesh.triangles()[i].b, mesh.triangles()[i].c};
    add(geometry, Hit::mesh, 0);
}

void RayScene::add_roadmap(const freespace::Freespace& mesh) {
    roadmap_ = freespace::roadmap_edges(mesh);
    if (roadmap_.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    const auto points =
        new_buffer<RoundPoint>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, 2 * roadmap_.size());
    const auto firsts =
        new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, roadmap_.size());
    for (std::uint32_t i = 0; i < roadmap_.size(); ++i) {
        for (std::uint32_t end = 0; end < 2; ++end) {
            const Vec3f place = mesh.vertices()[roadmap_[i][end]].position();
            points[2 * i + end] = round_point(place, layers_.roadmap_width * 0.5F);
        }
        firsts[i] = 2 * i;
    }
    add(geometry, Hit::roadmap, 0);
}

void RayScene::add_path(const Path& path, std::uint32_t layer) {
    std::vector<std::uint32_t> segments;
    for (std::uint32_t i = 0; i + 1 < path.points.size(); ++i) {
        if (path.points[i].allFinite() && path.points[i + 1].allFinite()) segments.push_back(i);
    }
    if (segments.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE);
    const auto points =
        new_buffer<RoundPoint>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, path.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3f& place = path.points[i];
        points[i] = round_point(place.allFinite() ? place : Vec3f(Vec3f::Zero()), path.width * 0.5F);
    }
    const auto firsts =
        new_buffer<std::uint32_t>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT, segments.size());
    std::copy(segments.begin(), segments.end(), firsts.begin());
    add(geometry, Hit::path, layer);
}

void RayScene::add_balls(const std::vector<Vec3f>& centres, float radius, Hit::Kind kind,
                         std::uint32_t layer) {
    if (centres.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    const auto points =
        new_buffer<RoundPoint>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT4, centres.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = round_point(centres[i], radius);
    add(geometry, kind, layer);
}

Hit RayScene::first_hit(const Ray& ray, float from) const {
    const Vec3f direction = ray.direction.cast<float>();
    Context context = context_of(view_, direction);
    RTCRayHit query{};
    query.ray = ray_of(ray.origin.cast<float>(), direction, from, std::numeric_limits<float>::infinity());
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(all_.get(), &context.embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    const Source& source = sources_[query.hit.geomID];
    Hit hit;
    hit.kind = source.kind;
    hit.layer = source.layer;
    hit.distance = query.ray.tfar;
    hit.normal = Vec3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized();
    hit.primitive = query.hit.primID;
    hit.u = query.hit.u;
    hit.v = query.hit.v;
    return hit;
}

bool RayScene::map_blocks(const Vec3f& from, const Vec3f& direction, float reach,
                          const Vec3f& seen_along) const {
    Context context = context_of(view_, seen_along);
    RTCRay ray = ray_of(from, direction, 0.0F, reach);
    rtcOccluded1(map_.get(), &context.embree, &ray);
    return ray.tfar < 0.0F;
}

const Colour& RayScene::colour(const Hit& hit) const {
    return hit.kind == Hit::path ? layers_.paths[hit.layer].colour : layers_.balls[hit.layer].colour;
}

float RayScene::free_distance(const Hit& hit) const {
    const auto vertices = layers_.mesh->vertices();
    if (hit.kind == Hit::roadmap) {
        const auto [a, b] = roadmap_[hit.primitive];
        return vertices[a].free_distance * (1.0F - hit.u) + vertices[b].free_distance * hit.u;
    }
    const freespace::Triangle& triangle = layers_.mesh->triangles()[hit.primitive];
    return (1.0F - hit.u - hit.v) * vertices[triangle.a].free_distance +
           hit.u * vertices[triangle.b].free_distance + hit.v * vertices[triangle.c].free_distance;
}

RayScene::InTriangle RayScene::in_triangle(const Hit& hit) const {
    const freespace::Triangle& triangle = layers_.mesh->triangles()[hit.primitive];
    const auto vertices = layers_.mesh->vertices();
    const Vec3f a = vertices[triangle.a].position();
    const Vec3f b = vertices[triangle.b].position();
    const Vec3f c = vertices[triangle.c].position();
    const float twice_area = (b - a).cross(c - a).norm();
    const float ab = (b - a).norm();
    const float bc = (c - b).norm();
    const float ca = (a - c).norm();
    // A barycentric coordinate times the height over its edge.
    const float to_edge = std::min(
        {(1.0F - hit.u - hit.v) * twice_area / bc, hit.u * twice_area / ca, hit.v * twice_area / ab});
    return {to_edge, twice_area / (ab + bc + ca)};
}

}  // namespace camdir::render
