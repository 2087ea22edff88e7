// The layers of a picture as geometry for ray casting (Embree).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "freespace/roadmap.hpp"
#include "render/draw.hpp"

struct RTCDeviceTy;
struct RTCGeometryTy;
struct RTCSceneTy;

namespace camdir::render {

struct Hit {
    enum Kind : std::uint8_t { nothing, map, cloud, mesh, roadmap, path, ball };
    Kind kind = nothing;
    float distance = 0.0F;         // along the ray
    Vec3f normal = Vec3f::Zero();  // length 1
    std::uint32_t layer = 0;       // which path or which balls
    std::uint32_t primitive = 0;
    float u = 0.0F, v = 0.0F;  // barycentric, of the second and third corner
};

// Immutable after construction; all const members are thread-safe. The layers and the view must outlive it.
class RayScene {
  public:
    RayScene(const Layers& layers, const View& view);

    // The nearest surface farther than `from` along the ray that is visible in the view.
    [[nodiscard]] Hit first_hit(const Ray& ray, float from) const;

    // Whether a part of the map that is visible along `seen_along` lies within `reach`.
    [[nodiscard]] bool map_blocks(const Vec3f& from, const Vec3f& direction, float reach,
                                  const Vec3f& seen_along) const;

    // Of a hit of kind path or ball.
    [[nodiscard]] const Colour& colour(const Hit& hit) const;
    // d_f at a hit of kind mesh or roadmap.
    [[nodiscard]] float free_distance(const Hit& hit) const;
    // From a hit of kind mesh to its triangle's nearest edge, and the radius of the triangle's inner circle.
    struct InTriangle {
        float to_edge, inner_radius;
    };
    [[nodiscard]] InTriangle in_triangle(const Hit& hit) const;

  private:
    struct Release {
        void operator()(RTCDeviceTy* device) const;
        void operator()(RTCSceneTy* scene) const;
    };

    void add_map(const scene::Scene& scene);
    void add_mesh(const freespace::Freespace& mesh);
    void add_roadmap(const freespace::Freespace& mesh);
    void add_path(const Path& path, std::uint32_t layer);
    void add_balls(const std::vector<Vec3f>& centres, float radius, Hit::Kind kind, std::uint32_t layer);
    void add(RTCGeometryTy* geometry, Hit::Kind kind, std::uint32_t layer);

    const Layers& layers_;
    const View& view_;
    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::unique_ptr<RTCSceneTy, Release> all_;  // every layer
    std::unique_ptr<RTCSceneTy, Release> map_;  // the map's triangles alone
    std::vector<freespace::RoadmapEdge> roadmap_;
    struct Source {
        Hit::Kind kind;
        std::uint32_t layer;
    };
    std::vector<Source> sources_;  // by geometry id of `all_`
};

}  // namespace camdir::render
