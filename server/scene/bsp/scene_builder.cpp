#include "scene/bsp/scene_builder.hpp"

#include <algorithm>

namespace camdir::scene {
namespace {

const char* const outside = "outside the world's box";

}  // namespace

SceneBuilder::SceneBuilder(const Box3d& world)
    : box_(world.min() - Vec3d::Constant(box_margin), world.max() + Vec3d::Constant(box_margin)),
      welder_(weld_tolerance) {}

Result<Scene> SceneBuilder::build(std::string_view entities, std::size_t model_count, BspFamily family,
                                  int eye_height,
                                  const std::function<Result<void>(const PlacedModel&)>& add_model) {
    const Result<std::vector<Entity>> parsed = parse_entities(entities);
    if (!parsed) return tl::unexpected(parsed.error());
    const Result<std::vector<PlacedModel>> models = placed_models(*parsed, model_count, family);
    if (!models) return tl::unexpected(models.error());
    for (const PlacedModel& placed : *models) {
        if (const Result<void> added = add_model(placed); !added) return tl::unexpected(added.error());
    }
    const Result<void> spawned = add_spawn_points(*parsed, eye_height);
    if (!spawned) return tl::unexpected(spawned.error());
    return take();
}

void SceneBuilder::add_surface(const Polygon& polygon) {
    const Polygon inside = clip_to_box(polygon, box_);
    if (inside.empty()) return skip(outside, "", area(polygon));
    for (const auto& [a, b, c] : triangulate(inside)) {
        welder_.add(inside[a], inside[b], inside[c]);
    }
}

bool SceneBuilder::add_volume(const Solid& solid) {
    if (!solid.bounds.intersects(box_)) {
        for (const SolidFace& face : solid.faces)
            skip(outside, "", area(face.polygon));
        return false;
    }
    scene_.brushes.push_back({static_cast<std::uint32_t>(scene_.planes.size()),
                              static_cast<std::uint32_t>(solid.planes.size()), solid.bounds});
    scene_.planes.insert(scene_.planes.end(), solid.planes.begin(), solid.planes.end());
    return true;
}

void SceneBuilder::add_mover(const PlacedModel& placed, std::vector<ConvexPart> parts) {
    scene_.movers.push_back(
        {"*" + std::to_string(placed.model), class_text(placed), std::move(parts), placed.origin});
}

void SceneBuilder::skip(const std::string& reason, std::string_view what, double area, std::uint64_t count) {
    Skipped& entry = skipped_[{reason, std::string(what)}];
    entry.count += count;
    entry.area += area;
}

Result<void> SceneBuilder::add_spawn_points(const std::vector<Entity>& entities, int eye_height) {
    for (const Entity& entity : entities) {
        if (!is_spawn_point(entity.class_name())) continue;
        const Result<Vec3d> origin = entity.origin();
        if (!origin) return tl::unexpected(origin.error());
        if (const std::optional<Vec3d> eye = eye_above(*origin, eye_height))
            scene_.spawn_points.push_back({*eye, entity.yaw(), std::string(entity.class_name())});
        else
            skip("spawn point in solid", entity.class_name(), 0.0);
    }
    return {};
}

Scene SceneBuilder::take() {
    scene_.metres_per_unit = metres_of_nominal_unit;
    scene_.vertices = welder_.take_vertices();
    scene_.triangles = welder_.take_triangles();
    scene_.bounds = box_;
    for (const Vec3d& vertex : scene_.vertices) {
        scene_.bounds.extend(vertex);
    }
    for (auto& [key, entry] : skipped_) {
        scene_.skipped.push_back({key.first, key.second, entry.count, entry.area});
    }
    return std::move(scene_);
}

bool SceneBuilder::in_solid(const Vec3d& point) const {
    return !box_.contains(point) ||
           std::any_of(scene_.brushes.begin(), scene_.brushes.end(), [&](const Brush& brush) {
               return brush.bounds.contains(point) && contains(scene_, brush, point);
           });
}

std::optional<Vec3d> SceneBuilder::eye_above(const Vec3d& origin, int eye_height) const {
    std::optional<Vec3d> eye;
    for (int height = 0; height <= eye_height; ++height) {
        const Vec3d candidate = origin + Vec3d(0.0, 0.0, height);
        const bool solid = in_solid(candidate);
        if (solid && eye) break;
        if (!solid) eye = candidate;
    }
    return eye;
}

}  // namespace camdir::scene
