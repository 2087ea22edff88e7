#include "scene/quake/bsp.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "scene/bsp/lumps.hpp"

namespace camdir::scene::quake {
namespace {

static_assert(sizeof(Plane) == 20 && sizeof(Vertex) == 12 && sizeof(Node) == 24 && sizeof(Edge) == 4);
static_assert(sizeof(TextureInfo) == 40 && sizeof(Face) == 20 && sizeof(Leaf) == 28 && sizeof(Model) == 64);

enum Lump : std::size_t {
    entities,
    planes,
    textures,
    vertices,
    visibility,
    nodes,
    texture_infos,
    faces,
    lighting,
    clip_nodes,
    leaves,
    leaf_faces,
    edges,
    surface_edges,
    models,
    lump_count
};
constexpr std::array<LumpFormat, lump_count> formats = {{{"entities", 1},
                                                         {"planes", sizeof(Plane)},
                                                         {"textures", 1},
                                                         {"vertices", sizeof(Vertex)},
                                                         {"visibility", 1},
                                                         {"nodes", sizeof(Node)},
                                                         {"texture infos", sizeof(TextureInfo)},
                                                         {"faces", sizeof(Face)},
                                                         {"lighting", 1},
                                                         {"clip nodes", 8},
                                                         {"leaves", sizeof(Leaf)},
                                                         {"leaf faces", 2},
                                                         {"edges", sizeof(Edge)},
                                                         {"surface edges", 4},
                                                         {"models", sizeof(Model)}}};
constexpr std::size_t table = 4;
constexpr std::size_t header_size = table + 8 * lump_count;
constexpr std::size_t texture_name_size = 16;
constexpr std::size_t max_nodes = 65535;

std::string missing(const char* what, std::int64_t index) {
    return std::string(what) + ' ' + std::to_string(index) + " does not exist";
}

// The lump begins with the number of textures and the place of each in the lump, -1 for none; a texture
// begins with its name.
Result<void> read_textures(const Lumps& lumps, std::vector<std::string>& names) {
    std::vector<char> bytes;
    if (const Result<void> read = lumps.read(textures, bytes); !read || bytes.empty()) return read;
    std::int32_t count = 0;
    if (bytes.size() >= sizeof count) std::memcpy(&count, bytes.data(), sizeof count);
    if (bytes.size() < sizeof count || count < 0 ||
        static_cast<std::size_t>(count) > bytes.size() / sizeof count - 1)
        return lumps.bad_lump(textures, std::to_string(count) + " textures do not fit into " +
                                            std::to_string(bytes.size()) + " bytes");
    for (std::int32_t i = 0; i < count; ++i) {
        std::int32_t place = 0;
        std::memcpy(&place, bytes.data() + sizeof place * (static_cast<std::size_t>(i) + 1), sizeof place);
        std::string& name = names.emplace_back();
        if (place == -1) continue;
        if (place < 0 || bytes.size() < texture_name_size ||
            static_cast<std::size_t>(place) > bytes.size() - texture_name_size)
            return lumps.bad_lump(textures, "texture " + std::to_string(i) + " at byte " +
                                                std::to_string(place) + " of the lump's " +
                                                std::to_string(bytes.size()) + "; expected it inside");
        const char* begin = bytes.data() + place;
        name.assign(begin, std::find(begin, begin + texture_name_size, '\0'));
    }
    return {};
}

Result<Bsp> read_lumps(const Lumps& lumps) {
    Bsp bsp{};
    for (std::size_t lump = 0; lump < lump_count; ++lump) {
        if (const Result<void> inside = lumps.check_place(lump); !inside)
            return tl::unexpected(inside.error());
    }
    const Result<void> done = lumps.read(entities, bsp.entities)
                                  .and_then([&] { return lumps.read(planes, bsp.planes); })
                                  .and_then([&] { return read_textures(lumps, bsp.textures); })
                                  .and_then([&] { return lumps.read(vertices, bsp.vertices); })
                                  .and_then([&] { return lumps.read(nodes, bsp.nodes); })
                                  .and_then([&] { return lumps.read(texture_infos, bsp.texture_infos); })
                                  .and_then([&] { return lumps.read(faces, bsp.faces); })
                                  .and_then([&] { return lumps.read(leaves, bsp.leaves); })
                                  .and_then([&] { return lumps.read(edges, bsp.edges); })
                                  .and_then([&] { return lumps.read(surface_edges, bsp.surface_edges); })
                                  .and_then([&] { return lumps.read(models, bsp.models); });
    if (!done) return tl::unexpected(done.error());
    return bsp;
}

Result<void> check_planes(const Lumps& lumps, const Bsp& bsp) {
    for (std::size_t i = 0; i < bsp.planes.size(); ++i) {
        if (!is_plane(bsp.planes[i].normal, bsp.planes[i].distance))
            return lumps.bad_element(planes, i, "expected a normal of length 1 and a distance below 2^20");
    }
    return {};
}

Result<void> check_vertices(const Lumps& lumps, const Bsp& bsp) {
    for (std::size_t i = 0; i < bsp.vertices.size(); ++i) {
        if (!is_position(bsp.vertices[i].position))
            return lumps.bad_element(vertices, i, "expected a position of numbers below 2^20");
    }
    return {};
}

bool exists(const Bsp& bsp, std::int32_t child) {
    return child < 0 ? in_range(-(child + 1), bsp.leaves.size()) : in_range(child, bsp.nodes.size());
}

// Also proves that what can be reached from the models' roots are trees: no node has two parents, no root has
// one, and no two models share one. Cycles elsewhere cannot be reached.
Result<void> check_trees(const Lumps& lumps, const Bsp& bsp) {
    if (bsp.nodes.size() > max_nodes)
        return lumps.bad_lump(nodes, std::to_string(bsp.nodes.size()) + " nodes; expected at most " +
                                         std::to_string(max_nodes));
    std::vector<bool> has_parent(bsp.nodes.size());
    const auto adopt = [&](std::int32_t child) {
        if (child < 0) return true;
        const auto node = static_cast<std::size_t>(child);
        if (has_parent[node]) return false;
        has_parent[node] = true;
        return true;
    };
    for (std::size_t i = 0; i < bsp.nodes.size(); ++i) {
        if (!in_range(bsp.nodes[i].plane, bsp.planes.size()))
            return lumps.bad_element(nodes, i, missing("plane", bsp.nodes[i].plane));
        for (std::size_t side = 0; side < 2; ++side) {
            const std::int32_t child = bsp.child_of(bsp.nodes[i], side);
            if (!exists(bsp, child)) return lumps.bad_element(nodes, i, missing("child", child));
            if (!adopt(child))
                return lumps.bad_element(
                    nodes, i, "child " + std::to_string(child) + " has another parent; expected a tree");
        }
    }
    for (std::size_t i = 0; i < bsp.models.size(); ++i) {
        const std::int32_t root = bsp.models[i].head_nodes[0];
        if (!exists(bsp, root)) return lumps.bad_element(models, i, missing("node", root));
        if (!adopt(root))
            return lumps.bad_element(
                models, i,
                "node " + std::to_string(root) +
                    " has a parent or is another model's root; expected a tree of its own");
    }
    return {};
}

Result<void> check_edges(const Lumps& lumps, const Bsp& bsp) {
    for (std::size_t i = 0; i < bsp.edges.size(); ++i) {
        for (const std::uint16_t vertex : bsp.edges[i].vertices) {
            if (!in_range(vertex, bsp.vertices.size()))
                return lumps.bad_element(edges, i, missing("vertex", vertex));
        }
    }
    for (std::size_t i = 0; i < bsp.surface_edges.size(); ++i) {
        const std::int64_t edge = bsp.surface_edges[i];
        if (std::abs(edge) >= static_cast<std::int64_t>(bsp.edges.size()))
            return lumps.bad_element(surface_edges, i, missing("edge", edge));
    }
    return {};
}

Result<void> check_faces(const Lumps& lumps, const Bsp& bsp) {
    for (std::size_t i = 0; i < bsp.texture_infos.size(); ++i) {
        if (!in_range(bsp.texture_infos[i].texture, bsp.textures.size()))
            return lumps.bad_element(texture_infos, i, missing("texture", bsp.texture_infos[i].texture));
    }
    std::size_t used_edges = 0;
    for (std::size_t i = 0; i < bsp.faces.size(); ++i) {
        const Face& face = bsp.faces[i];
        if (!in_range(face.plane, bsp.planes.size()))
            return lumps.bad_element(faces, i, missing("plane", face.plane));
        if (!in_range(face.texture_info, bsp.texture_infos.size()))
            return lumps.bad_element(faces, i, missing("texture info", face.texture_info));
        if (!in_range(face.first_edge, face.edge_count, bsp.surface_edges.size()))
            return lumps.bad_element(faces, i, "its edges are not all in the file");
        used_edges += face.edge_count;
        if (used_edges > bsp.surface_edges.size())
            return lumps.bad_element(faces, i, "shares edges with another face; expected edges of its own");
    }
    return {};
}

Result<void> check_models(const Lumps& lumps, const Bsp& bsp) {
    if (bsp.models.empty()) return lumps.bad_lump(models, "is empty; expected at least the world");
    std::size_t used_faces = 0;
    for (std::size_t i = 0; i < bsp.models.size(); ++i) {
        const Model& model = bsp.models[i];
        if (!is_position(model.mins) || !is_position(model.maxs))
            return lumps.bad_element(models, i, "expected a box of numbers below 2^20");
        if (!in_range(model.first_face, model.face_count, bsp.faces.size()))
            return lumps.bad_element(models, i, "its faces are not all in the file");
        used_faces += static_cast<std::size_t>(model.face_count);
        if (used_faces > bsp.faces.size())
            return lumps.bad_element(models, i, "shares faces with another model; expected faces of its own");
    }
    return {};
}

}  // namespace

std::int32_t Bsp::child_of(const Node& node, std::size_t side) const {
    const std::uint16_t child = node.children[side];
    return child < nodes.size() ? child : child - 65536;
}

scene::Plane Bsp::plane(std::int32_t index) const {
    const Plane& plane = planes[static_cast<std::size_t>(index)];
    return to_plane(plane.normal, plane.distance);
}

Result<Bsp> parse_bsp(std::span<const std::byte> bytes) {
    if (bytes.size() < header_size)
        return fail("ends after " + std::to_string(bytes.size()) + " bytes; expected a header of " +
                    std::to_string(header_size));
    std::int32_t version = 0;
    std::memcpy(&version, bytes.data(), sizeof version);
    if (version != version_quake && version != version_goldsrc)
        return fail("byte 0: expected version 29 (Quake) or 30 (GoldSrc); the version is " +
                    std::to_string(version));
    const Lumps lumps(bytes, table, formats);
    Result<Bsp> bsp = read_lumps(lumps);
    if (!bsp) return bsp;
    bsp->byte_size = bytes.size();
    bsp->version = version;
    const Result<void> checked = check_planes(lumps, *bsp)
                                     .and_then([&] { return check_vertices(lumps, *bsp); })
                                     .and_then([&] { return check_trees(lumps, *bsp); })
                                     .and_then([&] { return check_edges(lumps, *bsp); })
                                     .and_then([&] { return check_faces(lumps, *bsp); })
                                     .and_then([&] { return check_models(lumps, *bsp); });
    if (!checked) return tl::unexpected(checked.error());
    return bsp;
}

}  // namespace camdir::scene::quake
