#include "scene/quake3/read_scene.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <vector>

#include "scene/bsp/scene_builder.hpp"
#include "scene/quake3/bsp.hpp"
#include "scene/quake3/patches.hpp"
#include "scene/quake3/tree.hpp"

namespace camdir::scene {
namespace {

// The game lets players appear 9 above the entity; their eyes are 26 above their origin.
constexpr int eye_height = 9 + 26;

Box3d world_of(const q3::Bsp& bsp) {
    const q3::Model& world = bsp.models[0];
    Box3d box;
    box.extend(Vec3d(world.mins[0], world.mins[1], world.mins[2]));
    box.extend(Vec3d(world.maxs[0], world.maxs[1], world.maxs[2]));
    return box;
}

bool is_obstacle(const q3::Shader& shader) {
    return (shader.contents & q3::contents_solid) != 0 || (shader.surface_flags & q3::surface_sky) != 0;
}

// Of the entities with brush models: what never moves and blocks the view.
bool is_static(std::string_view class_name) {
    return class_name == "func_static";
}

const char* why_no_obstacle(const q3::Shader& shader) {
    if ((shader.contents & q3::contents_liquid) != 0) return "liquid";
    if ((shader.contents & q3::contents_fog) != 0) return "fog";
    if ((shader.contents & q3::contents_clip) != 0) return "clip";
    return "not solid";
}

std::string_view name_of(const q3::Shader& shader) {
    const auto end = std::find(shader.name.begin(), shader.name.end(), '\0');
    return {shader.name.data(), static_cast<std::size_t>(end - shader.name.begin())};
}

std::vector<Plane> planes_of(const q3::Bsp& bsp, const q3::Brush& brush, const Vec3d& translation) {
    std::vector<Plane> planes;
    for (std::int32_t i = 0; i < brush.side_count; ++i) {
        const q3::BrushSide& side = bsp.brush_sides[static_cast<std::size_t>(brush.first_side + i)];
        Plane plane = q3::to_plane(bsp.planes[static_cast<std::size_t>(side.plane)]);
        plane.distance += plane.normal.dot(translation);
        planes.push_back(plane);
    }
    return planes;
}

std::vector<Polygon> soup_triangles(const q3::Bsp& bsp, const q3::Face& face) {
    const auto corner = [&](std::int32_t k) {
        const std::int32_t index = bsp.indices[static_cast<std::size_t>(face.first_index + k)];
        const auto& p = bsp.vertices[static_cast<std::size_t>(face.first_vertex + index)].position;
        return Vec3d(p[0], p[1], p[2]);
    };
    std::vector<Polygon> triangles;
    for (std::int32_t k = 0; k < face.index_count; k += 3) {
        triangles.push_back({corner(k), corner(k + 1), corner(k + 2)});
    }
    return triangles;
}

class Reader {
  public:
    explicit Reader(const q3::Bsp& bsp) : bsp_(bsp), tree_(bsp), builder_(world_of(bsp)) {}

    [[nodiscard]] Result<Scene> read();

  private:
    // `skipped_as` is the class of an entity that is no obstacle; empty: the model is one.
    [[nodiscard]] Result<void> add_model(std::size_t number, const Vec3d& translation,
                                         std::string_view skipped_as = {});
    void add_brush(const q3::Brush& brush, const Vec3d& translation, std::string_view skipped_as);
    [[nodiscard]] Result<void> add_face(const q3::Face& face, const Vec3d& translation,
                                        std::string_view skipped_as);
    [[nodiscard]] Result<std::vector<Polygon>> triangles_of(const q3::Face& face);
    [[nodiscard]] const q3::Shader& shader(std::int32_t number) const {
        return bsp_.shaders[static_cast<std::size_t>(number)];
    }

    const q3::Bsp& bsp_;
    q3::Tree tree_;
    SceneBuilder builder_;
    std::size_t patch_triangles_ = 0;
};

Result<Scene> Reader::read() {
    const Result<std::vector<Entity>> entities = parse_entities(bsp_.entities);
    if (!entities) return tl::unexpected(entities.error());
    const Result<std::vector<PlacedModel>> models = placed_models(*entities, bsp_.models.size(), is_static);
    if (!models) return tl::unexpected(models.error());

    if (const Result<void> world = add_model(0, Vec3d::Zero()); !world) return tl::unexpected(world.error());
    for (const PlacedModel& placed : *models) {
        const Result<void> added = add_model(placed.model, placed.origin,
                                             placed.is_obstacle ? std::string_view() : placed.class_name);
        if (!added) return tl::unexpected(added.error());
    }
    const Result<void> spawned = builder_.add_spawn_points(*entities, eye_height);
    if (!spawned) return tl::unexpected(spawned.error());
    return builder_.take(metres_of_nominal_unit);
}

Result<void> Reader::add_model(std::size_t number, const Vec3d& translation, std::string_view skipped_as) {
    const q3::Model& model = bsp_.models[number];
    for (std::int32_t i = 0; i < model.brush_count; ++i) {
        add_brush(bsp_.brushes[static_cast<std::size_t>(model.first_brush + i)], translation, skipped_as);
    }
    for (std::int32_t i = 0; i < model.face_count; ++i) {
        const q3::Face& face = bsp_.faces[static_cast<std::size_t>(model.first_face + i)];
        if (const Result<void> added = add_face(face, translation, skipped_as); !added) return added;
    }
    return {};
}

void Reader::add_brush(const q3::Brush& brush, const Vec3d& translation, std::string_view skipped_as) {
    const q3::Shader& kind = shader(brush.shader);
    const Solid solid = make_solid(planes_of(bsp_, brush, translation));
    const bool obstacle = is_obstacle(kind);
    if (!skipped_as.empty() || !obstacle) {
        for (const SolidFace& face : solid.faces) {
            if (obstacle)
                builder_.skip("entity", skipped_as, area(face.polygon));
            else
                builder_.skip(why_no_obstacle(kind), name_of(kind), area(face.polygon));
        }
        return;
    }
    if (solid.faces.empty()) return builder_.skip("brush without volume", name_of(kind), 0.0);
    if (!builder_.add_volume(solid)) return;
    for (const SolidFace& face : solid.faces) {
        if (tree_.is_seen(face.polygon, face.normal))
            builder_.add_surface(face.polygon);
        else
            builder_.skip("face that nobody can see", "", area(face.polygon));
    }
}

Result<void> Reader::add_face(const q3::Face& face, const Vec3d& translation, std::string_view skipped_as) {
    const Result<std::vector<Polygon>> triangles = triangles_of(face);
    if (!triangles) return tl::unexpected(triangles.error());
    const q3::Shader& kind = shader(face.shader);
    for (Polygon triangle : *triangles) {
        for (Vec3d& corner : triangle)
            corner += translation;
        if (!is_obstacle(kind))
            builder_.skip(why_no_obstacle(kind), name_of(kind), area(triangle));
        else if (!skipped_as.empty())
            builder_.skip("entity", skipped_as, area(triangle));
        else
            builder_.add_surface(triangle);
    }
    return {};
}

// None for the drawings of brush faces, and for flares.
Result<std::vector<Polygon>> Reader::triangles_of(const q3::Face& face) {
    if (face.type == q3::triangle_soup) return soup_triangles(bsp_, face);
    std::vector<Polygon> triangles;
    if (face.type != q3::patch) return triangles;
    const Result<q3::Tessellation> tessellation =
        q3::tessellate(bsp_, face, bsp_.max_triangles() - patch_triangles_);
    if (!tessellation) return tl::unexpected(tessellation.error());
    patch_triangles_ += tessellation->triangle_count();
    for (const auto& [a, b, c] : tessellation->triangles()) {
        triangles.push_back({a, b, c});
    }
    return triangles;
}

}  // namespace

bool is_q3_bsp(std::span<const std::byte> bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "IBSP", 4) == 0;
}

Result<Scene> read_q3_scene(std::span<const std::byte> bytes) {
    const Result<q3::Bsp> bsp = q3::parse_bsp(bytes);
    if (!bsp) return tl::unexpected(bsp.error());
    return Reader(*bsp).read();
}

}  // namespace camdir::scene
