// What the readers of maps share: obstacles are collected, what is none is counted.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/bsp/entities.hpp"
#include "scene/bsp/solid.hpp"
#include "scene/scene.hpp"
#include "scene/triangle_welder.hpp"

namespace camdir::scene {

class SceneBuilder {
  public:
    // `world` is the box of the map's own world: surfaces end there.
    explicit SceneBuilder(const Box3d& world);

    // A convex polygon of an obstacle. Corners are welded, flat triangles dropped.
    void add_surface(const Polygon& polygon);

    // The volume of an obstacle, without its surface. False, and counted, when it lies outside the world.
    bool add_volume(const Solid& solid);

    // `what`: texture, shader or class of entities, as Skipped says.
    void skip(const std::string& reason, std::string_view what, double area, std::uint64_t count = 1);

    // Players' eyes are `eye_height` above a spawn point's entity, or as high above it as there is room below
    // the first volume: ceilings may be low, and some entities are sunk into the floor. Call it after the
    // volumes are complete. Fails when an origin is no position.
    [[nodiscard]] Result<void> add_spawn_points(const std::vector<Entity>& entities, int eye_height);

    [[nodiscard]] std::size_t plane_count() const { return scene_.planes.size(); }

    // Everything collected; the builder is empty afterwards.
    [[nodiscard]] Scene take(double metres_per_unit);

  private:
    // In a volume, or outside the world.
    [[nodiscard]] bool in_solid(const Vec3d& point) const;
    [[nodiscard]] std::optional<Vec3d> eye_above(const Vec3d& origin, int eye_height) const;

    Box3d box_;
    TriangleWelder welder_;
    Scene scene_;
    std::map<std::pair<std::string, std::string>, Skipped> skipped_;
};

}  // namespace camdir::scene
