// Embree's queries on a map's triangles: the yardstick.
#pragma once

#include <memory>
#include <span>

#include "base/geometry.hpp"
#include "scene/scene.hpp"

namespace camdir::bench {

class EmbreeQueries {
  public:
    explicit EmbreeQueries(const scene::Scene& scene);
    EmbreeQueries(EmbreeQueries&&) noexcept;
    ~EmbreeQueries();

    // One occlusion ray: nothing lies between the points.
    [[nodiscard]] bool clear(const Vec3f& from, const Vec3f& to) const;

    // One intersection ray: the share of the way to the first triangle; 1: nothing lies between the points.
    [[nodiscard]] float cast(const Vec3f& from, const Vec3f& to) const;

    // Occlusion rays from one point in a single call; how many are clear.
    [[nodiscard]] int clear_of_bundle(const Vec3f& from, std::span<const Vec3f> to) const;

    // One point query: distance to the nearest triangle.
    [[nodiscard]] float nearest(const Vec3f& point) const;

  private:
    struct Handles;
    std::unique_ptr<Handles> handles_;
};

}  // namespace camdir::bench
