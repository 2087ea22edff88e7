#include "scene/quake3/read_scene.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scene/bsp/lumps.hpp"
#include "scene/bsp/scene_builder.hpp"
#include "scene/quake3/bsp.hpp"
#include "scene/quake3/patches.hpp"
#include "scene/quake3/tree.hpp"

namespace camdir::scene {
namespace {

// Players appear 9 units above the entity; their eyes are 26 above their origin.
constexpr int eye_height = 9 + 26;

bool is_obstacle(const q3::Shader& shader) {
    return (shader.contents & q3::contents_solid) != 0 || (shader.surface_flags & q3::surface_sky) != 0;
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
        Plane plane = bsp.plane(side.plane);
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

class Quake3Reader {
  public:
    explicit Quake3Reader(const q3::Bsp& bsp)
        : bsp_(bsp), tree_(bsp), builder_(to_box(bsp.models[0].mins, bsp.models[0].maxs)) {}

    [[nodiscard]] Result<Scene> read();

  private:
    [[nodiscard]] Result<void> add_model(const PlacedModel& placed);
    // True when the model is a mover with a solid part.
    [[nodiscard]] bool keep_mover(const PlacedModel& placed);
    // With a reason, why all of the model is no obstacle.
    void add_brush(const q3::Brush& brush, const PlacedModel& placed, const std::string& reason);
    [[nodiscard]] Result<void> add_face(const q3::Face& face, const PlacedModel& placed,
                                        const std::string& reason);
    [[nodiscard]] Result<std::vector<Polygon>> triangles_of(const q3::Face& face);
    [[nodiscard]] std::span<const q3::Brush> brushes_of(const PlacedModel& placed) const;
    [[nodiscard]] const q3::Shader& shader(std::int32_t number) const {
        return bsp_.shaders[static_cast<std::size_t>(number)];
    }

    const q3::Bsp& bsp_;
    q3::Tree tree_;
    SceneBuilder builder_;
    std::size_t patch_triangles_ = 0;
};

Result<Scene> Quake3Reader::read() {
    return builder_.build(bsp_.entities, bsp_.models.size(), BspFamily::quake3, eye_height,
                          [&](const PlacedModel& placed) { return add_model(placed); });
}

Result<void> Quake3Reader::add_model(const PlacedModel& placed) {
    const std::string reason =
        placed.use == BrushUse::obstacle ? std::string() : skip_reason(placed, keep_mover(placed));
    for (const q3::Brush& brush : brushes_of(placed))
        add_brush(brush, placed, reason);
    const q3::Model& model = bsp_.models[placed.model];
    for (std::int32_t i = 0; i < model.face_count; ++i) {
        const q3::Face& face = bsp_.faces[static_cast<std::size_t>(model.first_face + i)];
        if (const Result<void> added = add_face(face, placed, reason); !added) return added;
    }
    return {};
}

bool Quake3Reader::keep_mover(const PlacedModel& placed) {
    if (placed.use != BrushUse::mover) return false;
    std::vector<ConvexPart> parts;
    for (const q3::Brush& brush : brushes_of(placed)) {
        if (!is_obstacle(shader(brush.shader))) continue;
        const Solid solid = make_solid(planes_of(bsp_, brush, Vec3d::Zero()));
        if (!solid.faces.empty()) parts.push_back(convex_part(solid));
    }
    if (parts.empty()) return false;
    builder_.add_mover(placed, std::move(parts));
    return true;
}

void Quake3Reader::add_brush(const q3::Brush& brush, const PlacedModel& placed, const std::string& reason) {
    const q3::Shader& kind = shader(brush.shader);
    const Solid solid = make_solid(planes_of(bsp_, brush, placed.origin));
    if (!is_obstacle(kind)) {
        for (const SolidFace& face : solid.faces)
            builder_.skip(why_no_obstacle(kind), name_of(kind), area(face.polygon));
        return;
    }
    if (!reason.empty()) {
        for (const SolidFace& face : solid.faces)
            builder_.skip(reason, "", area(face.polygon));
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

Result<void> Quake3Reader::add_face(const q3::Face& face, const PlacedModel& placed,
                                    const std::string& reason) {
    const Result<std::vector<Polygon>> triangles = triangles_of(face);
    if (!triangles) return tl::unexpected(triangles.error());
    const q3::Shader& kind = shader(face.shader);
    for (Polygon triangle : *triangles) {
        for (Vec3d& corner : triangle)
            corner += placed.origin;
        if (!is_obstacle(kind))
            builder_.skip(why_no_obstacle(kind), name_of(kind), area(triangle));
        else if (!reason.empty())
            builder_.skip(reason, "", area(triangle));
        else
            builder_.add_surface(triangle);
    }
    return {};
}

std::span<const q3::Brush> Quake3Reader::brushes_of(const PlacedModel& placed) const {
    const q3::Model& model = bsp_.models[placed.model];
    return std::span(bsp_.brushes)
        .subspan(static_cast<std::size_t>(model.first_brush), static_cast<std::size_t>(model.brush_count));
}

// None for brush faces, which the brushes give, and for flares.
Result<std::vector<Polygon>> Quake3Reader::triangles_of(const q3::Face& face) {
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
    return Quake3Reader(*bsp).read();
}

}  // namespace camdir::scene
