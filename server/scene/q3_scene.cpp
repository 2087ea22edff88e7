#include "scene/q3_scene.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scene/polygon.hpp"
#include "scene/q3_brushes.hpp"
#include "scene/q3_bsp.hpp"
#include "scene/q3_entities.hpp"
#include "scene/q3_patches.hpp"
#include "scene/q3_tree.hpp"
#include "scene/weld.hpp"

namespace camdir::scene {
namespace {

constexpr double metres_per_unit = 0.0254;
constexpr double weld_tolerance = 0.01;
// The world's box is the geometry's own, exact: room for rounding.
constexpr double box_margin = 1.0;
// The game lets players appear 9 above the entity; their eyes are 26 above their origin.
constexpr int eye_height = 9 + 26;

const q3::Shader& shader_of(const q3::Bsp& bsp, std::int32_t shader) {
    return bsp.shaders[static_cast<std::size_t>(shader)];
}

bool is_obstacle(const q3::Shader& shader) {
    return (shader.contents & q3::contents_solid) != 0 || (shader.surface_flags & q3::surface_sky) != 0;
}

std::string kind_of_brush(std::int32_t contents) {
    if ((contents & (8 | 16 | 32)) != 0) return "liquid brushes";
    if ((contents & 64) != 0) return "fog brushes";
    if ((contents & (0x10000 | 0x20000)) != 0) return "clip brushes";
    return "other non-solid brushes";
}

std::vector<Vec3d> soup_corners(const q3::Bsp& bsp, const q3::Face& face) {
    std::vector<Vec3d> corners;
    for (std::int32_t k = 0; k < face.index_count; ++k) {
        const std::int32_t index = bsp.indices[static_cast<std::size_t>(face.first_index + k)];
        const auto& p = bsp.vertices[static_cast<std::size_t>(face.first_vertex + index)].position;
        corners.emplace_back(p[0], p[1], p[2]);
    }
    return corners;
}

// Collects the obstacles of one model after the other.
class Collector {
  public:
    explicit Collector(const q3::Bsp& bsp) : bsp_(bsp), tree_(bsp), welder_(weld_tolerance) {
        const q3::Model& world = bsp.models[0];
        const Vec3d margin = Vec3d::Constant(box_margin);
        box_.extend(Vec3d(world.mins[0], world.mins[1], world.mins[2]) - margin);
        box_.extend(Vec3d(world.maxs[0], world.maxs[1], world.maxs[2]) + margin);
    }

    [[nodiscard]] Result<void> add_model(std::size_t model, const Vec3d& translation);
    void leave_out(const std::string& what, std::uint64_t count = 1) { left_out_[what] += count; }
    [[nodiscard]] bool in_solid(const Vec3d& point) const;
    [[nodiscard]] Scene finish(std::vector<SpawnPoint> spawn_points);

  private:
    void add_brush(const q3::Brush& brush, const Vec3d& translation);
    [[nodiscard]] Result<void> add_patch(const q3::Face& face, const Vec3d& translation);
    void add_soup(const q3::Face& face, const Vec3d& translation);
    [[nodiscard]] Result<void> add_face(const q3::Face& face, const Vec3d& translation);
    void add_polygon(const Polygon& polygon);

    const q3::Bsp& bsp_;
    q3::Tree tree_;
    Box3d box_;
    Welder welder_;
    std::size_t patch_triangles_ = 0;
    Scene scene_;
    std::map<std::string, std::uint64_t> left_out_;
};

Result<void> Collector::add_model(std::size_t number, const Vec3d& translation) {
    const q3::Model& model = bsp_.models[number];
    for (std::int32_t i = 0; i < model.brush_count; ++i) {
        add_brush(bsp_.brushes[static_cast<std::size_t>(model.first_brush + i)], translation);
    }
    for (std::int32_t i = 0; i < model.face_count; ++i) {
        const Result<void> added =
            add_face(bsp_.faces[static_cast<std::size_t>(model.first_face + i)], translation);
        if (!added) return added;
    }
    return {};
}

void Collector::add_brush(const q3::Brush& brush, const Vec3d& translation) {
    const q3::Shader& shader = shader_of(bsp_, brush.shader);
    if (!is_obstacle(shader)) return leave_out(kind_of_brush(shader.contents));
    const q3::Solid solid = q3::make_solid(bsp_, brush, translation);
    if (solid.faces.empty()) return leave_out("solid brushes without volume");
    if (!solid.bounds.intersects(box_)) return leave_out("solid brushes outside the world's box");
    scene_.brushes.push_back({static_cast<std::uint32_t>(scene_.planes.size()),
                              static_cast<std::uint32_t>(solid.planes.size()), solid.bounds});
    scene_.planes.insert(scene_.planes.end(), solid.planes.begin(), solid.planes.end());
    for (const q3::BrushFace& face : solid.faces) {
        if (tree_.is_seen(face.polygon, face.normal))
            add_polygon(face.polygon);
        else
            leave_out("brush faces that nobody can see");
    }
}

Result<void> Collector::add_face(const q3::Face& face, const Vec3d& translation) {
    const bool solid = is_obstacle(shader_of(bsp_, face.shader));
    switch (face.type) {
        case q3::patch:
            if (solid) return add_patch(face, translation);
            leave_out("non-solid patches");
            break;
        case q3::triangle_soup:
            if (solid)
                add_soup(face, translation);
            else
                leave_out("non-solid triangle soups");
            break;
        default:  // drawings of brush faces, and flares
            break;
    }
    return {};
}

Result<void> Collector::add_patch(const q3::Face& face, const Vec3d& translation) {
    const Result<q3::Tessellation> tessellation =
        q3::tessellate(bsp_, face, bsp_.max_triangles() - patch_triangles_);
    if (!tessellation) return tl::unexpected(tessellation.error());
    patch_triangles_ += tessellation->triangle_count();
    for (const auto& [a, b, c] : tessellation->triangles()) {
        add_polygon({a + translation, b + translation, c + translation});
    }
    return {};
}

void Collector::add_soup(const q3::Face& face, const Vec3d& translation) {
    const std::vector<Vec3d> corners = soup_corners(bsp_, face);
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        add_polygon({corners[i] + translation, corners[i + 1] + translation, corners[i + 2] + translation});
    }
}

void Collector::add_polygon(const Polygon& polygon) {
    const Polygon inside = cut_to_box(polygon, box_);
    if (inside.empty()) return leave_out("surfaces outside the world's box");
    for (const auto& [a, b, c] : triangulate(inside)) {
        welder_.add(inside[a], inside[b], inside[c]);
    }
}

bool Collector::in_solid(const Vec3d& point) const {
    return std::any_of(scene_.brushes.begin(), scene_.brushes.end(), [&](const Brush& brush) {
        if (!brush.bounds.contains(point)) return false;
        const auto planes = std::span(scene_.planes).subspan(brush.first_plane, brush.plane_count);
        return std::all_of(planes.begin(), planes.end(),
                           [&](const Plane& plane) { return plane.normal.dot(point) <= plane.distance; });
    });
}

Scene Collector::finish(std::vector<SpawnPoint> spawn_points) {
    scene_.metres_per_unit = metres_per_unit;
    scene_.vertices = welder_.take_vertices();
    scene_.triangles = welder_.take_triangles();
    scene_.bounds = box_;
    for (const Vec3d& vertex : scene_.vertices) {
        scene_.bounds.extend(vertex);
    }
    scene_.spawn_points = std::move(spawn_points);
    for (const auto& [what, count] : left_out_) {
        scene_.left_out.push_back({what, count});
    }
    return std::move(scene_);
}

// The world, and of the brush models of entities those that never move and that block the view.
Result<void> add_models(const q3::Bsp& bsp, const std::vector<q3::Entity>& entities, Collector& collector) {
    const Result<void> world = collector.add_model(0, Vec3d::Zero());
    if (!world) return world;
    std::vector<bool> used(bsp.models.size());
    for (const q3::Entity& entity : entities) {
        const std::optional<std::size_t> model = entity.brush_model();
        if (!model || *model == 0) continue;
        if (*model >= bsp.models.size())
            return fail("entity " + std::to_string(entity.number) + ": model *" + std::to_string(*model) +
                        " does not exist");
        if (entity.class_name() != "func_static") {
            collector.leave_out(std::string(entity.class_name()));
            continue;
        }
        if (used[*model])
            return fail("entity " + std::to_string(entity.number) + ": model *" + std::to_string(*model) +
                        " belongs to another entity already");
        used[*model] = true;
        const Result<Vec3d> origin = entity.origin();
        if (!origin) return tl::unexpected(origin.error());
        const Result<void> added = collector.add_model(*model, *origin);
        if (!added) return added;
    }
    return {};
}

// The highest free place between the entity and a standing player's eye: ceilings may be low, and some
// entities are sunk into the floor.
std::optional<Vec3d> eye_above(const Vec3d& origin, const Collector& collector) {
    std::optional<Vec3d> eye;
    for (int height = 0; height <= eye_height; ++height) {
        const Vec3d candidate = origin + Vec3d(0.0, 0.0, height);
        const bool solid = collector.in_solid(candidate);
        if (solid && eye) break;
        if (!solid) eye = candidate;
    }
    return eye;
}

Result<std::vector<SpawnPoint>> find_spawn_points(const std::vector<q3::Entity>& entities,
                                                  Collector& collector) {
    std::vector<SpawnPoint> spawn_points;
    for (const q3::Entity& entity : entities) {
        if (!q3::is_spawn_point(entity.class_name())) continue;
        const Result<Vec3d> origin = entity.origin();
        if (!origin) return tl::unexpected(origin.error());
        if (const std::optional<Vec3d> eye = eye_above(*origin, collector))
            spawn_points.push_back({*eye, entity.yaw(), std::string(entity.class_name())});
        else
            collector.leave_out("spawn points in solid");
    }
    return spawn_points;
}

}  // namespace

bool is_q3_bsp(std::span<const std::byte> bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "IBSP", 4) == 0;
}

Result<Scene> read_q3_scene(std::span<const std::byte> bytes) {
    const Result<q3::Bsp> bsp = q3::parse_bsp(bytes);
    if (!bsp) return tl::unexpected(bsp.error());
    const Result<std::vector<q3::Entity>> entities = q3::parse_entities(bsp->entities);
    if (!entities) return tl::unexpected(entities.error());

    Collector collector(*bsp);
    const Result<void> added = add_models(*bsp, *entities, collector);
    if (!added) return tl::unexpected(added.error());
    Result<std::vector<SpawnPoint>> spawn_points = find_spawn_points(*entities, collector);
    if (!spawn_points) return tl::unexpected(spawn_points.error());
    return collector.finish(std::move(*spawn_points));
}

}  // namespace camdir::scene
