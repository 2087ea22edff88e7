#include "support/quake_maps.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "scene/bsp/solid.hpp"
#include "scene/quake/read_scene.hpp"
#include "support/bsp_writer.hpp"

namespace camdir::test {
namespace {

namespace quake = scene::quake;

template <class Element>
std::int32_t count(const std::vector<Element>& elements) {
    return static_cast<std::int32_t>(elements.size());
}

class Compiler {
  public:
    explicit Compiler(const QuakeMap& map);
    [[nodiscard]] quake::Bsp take() { return std::move(bsp_); }

  private:
    std::int32_t add_plane(const scene::Plane& plane);
    std::uint16_t add_node(const scene::Plane& plane, std::uint16_t front, std::uint16_t back);
    std::uint16_t add_leaf(std::int32_t contents);
    std::uint16_t add_tree(const std::vector<QuakeBox>& boxes);
    void add_face(const scene::SolidFace& face, const std::string& texture, bool inwards);
    void add_model(const QuakeEntity& entity);
    std::uint16_t texture_info(const std::string& texture);

    quake::Bsp bsp_{};
};

std::int32_t Compiler::add_plane(const scene::Plane& plane) {
    bsp_.planes.push_back({floats(plane.normal), static_cast<float>(plane.distance), 0});
    return count(bsp_.planes) - 1;
}

std::uint16_t Compiler::add_node(const scene::Plane& plane, std::uint16_t front, std::uint16_t back) {
    quake::Node node{};
    node.plane = add_plane(plane);
    node.children = {front, back};
    bsp_.nodes.push_back(node);
    return static_cast<std::uint16_t>(bsp_.nodes.size() - 1);
}

std::uint16_t Compiler::add_leaf(std::int32_t contents) {
    bsp_.leaves.push_back({contents, {}});
    return static_cast<std::uint16_t>(65536 - count(bsp_.leaves));
}

// The sides of the first box cut the space; what lies before one of them holds the parts of the other boxes
// that reach there.
std::uint16_t Compiler::add_tree(const std::vector<QuakeBox>& boxes) {
    if (boxes.empty()) return add_leaf(quake::empty);
    std::uint16_t child = add_leaf(boxes.front().contents);
    const scene::Solid first = scene::make_solid(boxes.front().box);
    for (const scene::Plane& plane : first.planes) {
        std::vector<QuakeBox> before;
        std::copy_if(boxes.begin() + 1, boxes.end(), std::back_inserter(before), [&](const QuakeBox& other) {
            const Vec3d farthest =
                (plane.normal.array() > 0.0).select(other.box.max().array(), other.box.min().array());
            return plane.normal.dot(farthest) > plane.distance;
        });
        child = add_node(plane, add_tree(before), child);
    }
    return child;
}

std::uint16_t Compiler::texture_info(const std::string& texture) {
    const auto found = std::find(bsp_.textures.begin(), bsp_.textures.end(), texture);
    const auto number = static_cast<std::int32_t>(found - bsp_.textures.begin());
    if (found == bsp_.textures.end()) {
        bsp_.textures.push_back(texture);
        bsp_.texture_infos.push_back({{}, number, 0});
    }
    return static_cast<std::uint16_t>(number);
}

void Compiler::add_face(const scene::SolidFace& face, const std::string& texture, bool inwards) {
    quake::Face made{};
    made.plane = static_cast<std::uint16_t>(add_plane({face.normal, face.normal.dot(face.polygon[0])}));
    made.side = inwards ? 1 : 0;
    made.first_edge = count(bsp_.surface_edges);
    made.edge_count = static_cast<std::uint16_t>(face.polygon.size());
    made.texture_info = texture_info(texture);
    bsp_.faces.push_back(made);
    const auto first = static_cast<std::uint16_t>(bsp_.vertices.size());
    for (std::size_t i = 0; i < face.polygon.size(); ++i) {
        bsp_.vertices.push_back({floats(face.polygon[i])});
        const auto from = static_cast<std::uint16_t>(first + i);
        const auto to = static_cast<std::uint16_t>(first + (i + 1) % face.polygon.size());
        const bool reversed = i % 2 == 1;
        bsp_.surface_edges.push_back(reversed ? -count(bsp_.edges) : count(bsp_.edges));
        bsp_.edges.push_back({{reversed ? to : from, reversed ? from : to}});
    }
}

void Compiler::add_model(const QuakeEntity& entity) {
    quake::Model model{};
    Box3d bounds;
    model.first_face = count(bsp_.faces);
    for (const QuakeBox& box : entity.boxes) {
        bounds.extend(box.box);
        for (const scene::SolidFace& face : scene::make_solid(box.box).faces)
            add_face(face, box.texture, false);
    }
    model.mins = floats(bounds.min());
    model.maxs = floats(bounds.max());
    model.face_count = count(bsp_.faces) - model.first_face;
    model.head_nodes[0] = add_tree(entity.boxes);
    bsp_.models.push_back(model);
}

Compiler::Compiler(const QuakeMap& map) {
    bsp_.version = map.version;
    bsp_.entities = "{\n\"classname\" \"worldspawn\"\n}\n";
    bsp_.edges.push_back({});  // never used: an edge's number needs a sign

    quake::Model world{};
    world.mins = floats(map.room.min() - Vec3d::Constant(wall));
    world.maxs = floats(map.room.max() + Vec3d::Constant(wall));
    std::uint16_t child = add_tree(map.boxes);
    const scene::Solid room = scene::make_solid(map.room);
    for (const scene::SolidFace& face : room.faces)
        add_face(face, map.wall_texture, true);
    for (const QuakeBox& box : map.boxes)
        for (const scene::SolidFace& face : scene::make_solid(box.box).faces)
            add_face(face, box.texture, false);
    for (const scene::Plane& plane : room.planes)
        child = add_node(plane, add_leaf(quake::solid), child);
    world.head_nodes[0] = child;
    world.face_count = count(bsp_.faces);
    bsp_.models.push_back(world);

    for (const QuakeEntity& entity : map.entities) {
        std::ostringstream text;
        text << "{ \"classname\" \"" << entity.class_name << "\" \"angle\" \"90\" \"origin\" \""
             << entity.origin.x() << ' ' << entity.origin.y() << ' ' << entity.origin.z() << '"';
        if (!entity.boxes.empty()) {
            text << " \"model\" \"*" << bsp_.models.size() << '"';
            add_model(entity);
        }
        text << " }\n";
        bsp_.entities += text.str();
    }
}

std::vector<std::byte> texture_lump(const std::vector<std::string>& names) {
    constexpr std::size_t size_of_texture = 40;
    const std::size_t table = 4 * (names.size() + 1);
    std::vector<std::byte> bytes(table + size_of_texture * names.size());
    const std::int32_t number = count(names);
    std::memcpy(bytes.data(), &number, 4);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::size_t place = table + size_of_texture * i;
        const auto offset = static_cast<std::int32_t>(place);
        std::memcpy(bytes.data() + 4 * (i + 1), &offset, 4);
        std::memcpy(bytes.data() + place, names[i].data(), std::min<std::size_t>(names[i].size(), 16));
    }
    return bytes;
}

}  // namespace

quake::Bsp bsp_of(const QuakeMap& map) {
    return Compiler(map).take();
}

Bytes encode(const quake::Bsp& bsp) {
    const std::string magic = {static_cast<char>(bsp.version), 0, 0, 0};
    BspWriter writer(magic, 15);
    writer.lump(0, bsp.entities);
    writer.lump(1, bsp.planes);
    writer.lump(2, texture_lump(bsp.textures));
    writer.lump(3, bsp.vertices);
    writer.lump(5, bsp.nodes);
    writer.lump(6, bsp.texture_infos);
    writer.lump(7, bsp.faces);
    writer.lump(10, bsp.leaves);
    writer.lump(12, bsp.edges);
    writer.lump(13, bsp.surface_edges);
    writer.lump(14, bsp.models);
    return writer.take();
}

scene::Scene scene_of(const QuakeMap& map) {
    Result<scene::Scene> scene = scene::read_quake_scene(encode(bsp_of(map)));
    if (!scene) throw std::runtime_error(scene.error().message);
    return std::move(*scene);
}

}  // namespace camdir::test
