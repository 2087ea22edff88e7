// What the BSP readers share: a scene from the models that a map's entities place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
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

    // Calls `add_model`, which is to add or skip the model's parts, for the world and for every entity's
    // brush model, then adds the spawn points. Players' eyes are `eye_height` above a spawn point's entity,
    // or as high above it as there is room below the first volume: ceilings may be low, and some entities are
    // sunk into the floor. Once; the builder is empty afterwards.
    [[nodiscard]] Result<Scene> build(std::string_view entities, std::size_t model_count, BspFamily family,
                                      int eye_height,
                                      const std::function<Result<void>(const PlacedModel&)>& add_model);

    // A convex polygon of an obstacle. Corners are welded, flat triangles dropped.
    void add_surface(const Polygon& polygon);

    // The volume of an obstacle, without its surface. False, and counted, when it lies outside the world.
    bool add_volume(const Solid& solid);

    // What is solid of it, at least one part, before `placed.origin` is added.
    void add_mover(const PlacedModel& placed, std::vector<ConvexPart> parts);

    void skip(const std::string& reason, std::string_view what, double area, std::uint64_t count = 1);

  private:
    [[nodiscard]] Result<void> add_spawn_points(const std::vector<Entity>& entities, int eye_height);
    // In a volume, or outside the world.
    [[nodiscard]] bool in_solid(const Vec3d& point) const;
    [[nodiscard]] std::optional<Vec3d> eye_above(const Vec3d& origin, int eye_height) const;
    [[nodiscard]] Scene take();

    Box3d box_;
    TriangleWelder welder_;
    Scene scene_;
    std::map<std::pair<std::string, std::string>, Skipped> skipped_;
};

}  // namespace camdir::scene
