#include "scene/quake/read_scene.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene/bsp/lumps.hpp"
#include "scene/bsp/scene_builder.hpp"
#include "scene/quake/bsp.hpp"
#include "scene/quake/tree.hpp"

namespace camdir::scene {
namespace {

// Players appear 1 unit above the entity; the rest is the height of their eyes.
constexpr int eye_height_quake = 1 + 22;
constexpr int eye_height_goldsrc = 1 + 28;
// A face's leaf is looked up this far behind it: more than rounding in the planes, less than any wall.
constexpr double behind = 0.125;

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

std::string lower_case(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

bool is_liquid(std::string_view texture) {
    return texture.starts_with('!') || texture.starts_with('*');
}

// For the compilers; no game draws them.
bool is_tool(std::string_view texture) {
    return texture.starts_with("clip") || is_one_of(texture, {"trigger", "aaatrigger", "null", "skip", "hint",
                                                              "hintskip", "origin", "bevel"});
}

Polygon translated(Polygon polygon, const Vec3d& translation) {
    for (Vec3d& corner : polygon)
        corner += translation;
    return polygon;
}

class QuakeReader {
  public:
    explicit QuakeReader(const quake::Bsp& bsp)
        : bsp_(bsp), tree_(bsp), builder_(to_box(bsp.models[0].mins, bsp.models[0].maxs)) {}

    [[nodiscard]] Result<Scene> read();

  private:
    [[nodiscard]] Result<void> add_model(std::size_t number, const Vec3d& translation);
    [[nodiscard]] Result<void> add_volumes(const quake::Model& model, const Vec3d& translation);
    // Each solid leaf of the model as a volume. Fails when all volumes have too many planes.
    [[nodiscard]] Result<void> for_each_volume(const quake::Model& model,
                                               const std::function<Result<void>(const Solid&)>& visit);
    [[nodiscard]] Result<void> skip_model(const PlacedModel& placed);
    // What is solid of a mover.
    [[nodiscard]] Result<std::vector<ConvexPart>> parts_of(const PlacedModel& placed);
    // Behind the face lies a solid leaf of its model.
    [[nodiscard]] bool closes_solid(const quake::Model& model, const quake::Face& face,
                                    const Polygon& polygon) const;

    [[nodiscard]] std::span<const quake::Face> faces_of(const quake::Model& model) const;
    [[nodiscard]] std::string_view texture_of(const quake::Face& face) const;
    [[nodiscard]] Polygon polygon_of(const quake::Face& face) const;

    const quake::Bsp& bsp_;
    quake::Tree tree_;
    SceneBuilder builder_;
    std::size_t volume_planes_ = 0;
};

Result<Scene> QuakeReader::read() {
    const int eye_height = bsp_.version == quake::version_quake ? eye_height_quake : eye_height_goldsrc;
    return builder_.build(bsp_.entities, bsp_.models.size(), BspFamily::quake, eye_height,
                          [&](const PlacedModel& placed) -> Result<void> {
                              return placed.use == BrushUse::obstacle ? add_model(placed.model, placed.origin)
                                                                      : skip_model(placed);
                          });
}

// Faces that close what is solid are parts of its surface, which the volumes give without holes. A model
// whose faces are all skipped is no obstacle, and neither is its volume.
Result<void> QuakeReader::add_model(std::size_t number, const Vec3d& translation) {
    const quake::Model& model = bsp_.models[number];
    const bool is_world = number == 0;
    bool is_obstacle = is_world;
    for (const quake::Face& face : faces_of(model)) {
        const Polygon polygon = polygon_of(face);
        const std::string_view texture = texture_of(face);
        const std::string name = lower_case(std::string(texture));
        const bool closes = closes_solid(model, face, polygon);
        if (is_liquid(name)) {
            builder_.skip("liquid", texture, area(polygon));
        } else if (is_tool(name) && !(is_world && closes)) {
            builder_.skip("tool texture", texture, area(polygon));
        } else {
            if (!closes) builder_.add_surface(translated(polygon, translation));
            is_obstacle = true;
        }
    }
    return is_obstacle ? add_volumes(model, translation) : Result<void>();
}

Result<void> QuakeReader::add_volumes(const quake::Model& model, const Vec3d& translation) {
    const std::int32_t root = model.head_nodes[0];
    const auto add_part = [&](const Polygon& part) { builder_.add_surface(translated(part, translation)); };
    return for_each_volume(model, [&](const Solid& leaf) -> Result<void> {
        for (const SolidFace& face : leaf.faces) {
            const Result<void> added = tree_.for_each_open_part(root, face, add_part);
            if (!added) return added;
        }
        Solid moved = leaf;
        moved.bounds.translate(translation);
        for (Plane& plane : moved.planes)
            plane.distance += plane.normal.dot(translation);
        builder_.add_volume(moved);
        return {};
    });
}

Result<void> QuakeReader::for_each_volume(const quake::Model& model,
                                          const std::function<Result<void>(const Solid&)>& visit) {
    Box3d box = to_box(model.mins, model.maxs);
    box.min() -= Vec3d::Ones();
    box.max() += Vec3d::Ones();
    return tree_.for_each_solid_leaf(model.head_nodes[0], box, [&](const Solid& leaf) -> Result<void> {
        volume_planes_ += leaf.planes.size();
        if (volume_planes_ <= bsp_.max_volume_planes()) return visit(leaf);
        return fail("lump 5 (nodes): the solid leaves have more than " +
                    std::to_string(bsp_.max_volume_planes()) +
                    " planes, which is the limit for a file of this size");
    });
}

Result<void> QuakeReader::skip_model(const PlacedModel& placed) {
    Result<std::vector<ConvexPart>> parts = parts_of(placed);
    if (!parts) return tl::unexpected(parts.error());
    const std::string reason = skip_reason(placed, !parts->empty());
    if (!parts->empty()) builder_.add_mover(placed, std::move(*parts));
    for (const quake::Face& face : faces_of(bsp_.models[placed.model]))
        builder_.skip(reason, "", area(polygon_of(face)));
    return {};
}

// As of an obstacle: nothing where all faces are liquid or of tool textures.
Result<std::vector<ConvexPart>> QuakeReader::parts_of(const PlacedModel& placed) {
    std::vector<ConvexPart> parts;
    const quake::Model& model = bsp_.models[placed.model];
    const auto faces = faces_of(model);
    const bool has_body = std::any_of(faces.begin(), faces.end(), [&](const quake::Face& face) {
        const std::string texture = lower_case(std::string(texture_of(face)));
        return !is_liquid(texture) && !is_tool(texture);
    });
    if (placed.use != BrushUse::mover || !has_body) return parts;
    const Result<void> visited = for_each_volume(model, [&](const Solid& leaf) -> Result<void> {
        parts.push_back(convex_part(leaf));
        return {};
    });
    if (!visited) return tl::unexpected(visited.error());
    return parts;
}

bool QuakeReader::closes_solid(const quake::Model& model, const quake::Face& face,
                               const Polygon& polygon) const {
    if (polygon.empty()) return false;
    Vec3d middle = Vec3d::Zero();
    for (const Vec3d& corner : polygon)
        middle += corner / static_cast<double>(polygon.size());
    const Vec3d normal = bsp_.plane(face.plane).normal * (face.side == 0 ? 1.0 : -1.0);
    return tree_.in_solid_leaf(model.head_nodes[0], middle - normal * behind);
}

std::span<const quake::Face> QuakeReader::faces_of(const quake::Model& model) const {
    return std::span(bsp_.faces)
        .subspan(static_cast<std::size_t>(model.first_face), static_cast<std::size_t>(model.face_count));
}

std::string_view QuakeReader::texture_of(const quake::Face& face) const {
    return bsp_.textures[static_cast<std::size_t>(bsp_.texture_infos[face.texture_info].texture)];
}

Polygon QuakeReader::polygon_of(const quake::Face& face) const {
    Polygon polygon;
    for (std::int32_t i = 0; i < face.edge_count; ++i) {
        const std::int32_t signed_edge = bsp_.surface_edges[static_cast<std::size_t>(face.first_edge + i)];
        const quake::Edge& edge = bsp_.edges[static_cast<std::size_t>(std::abs(signed_edge))];
        const auto& p = bsp_.vertices[edge.vertices[signed_edge < 0 ? 1 : 0]].position;
        polygon.emplace_back(p[0], p[1], p[2]);
    }
    return polygon;
}

}  // namespace

bool is_quake_bsp(std::span<const std::byte> bytes) {
    std::int32_t version = 0;
    if (bytes.size() < sizeof version) return false;
    std::memcpy(&version, bytes.data(), sizeof version);
    return version == quake::version_quake || version == quake::version_goldsrc;
}

Result<Scene> read_quake_scene(std::span<const std::byte> bytes) {
    const Result<quake::Bsp> bsp = quake::parse_bsp(bytes);
    if (!bsp) return tl::unexpected(bsp.error());
    return QuakeReader(*bsp).read();
}

}  // namespace camdir::scene
