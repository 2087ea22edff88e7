#include "scene/quake3/bsp.hpp"

#include "scene/bsp/lumps.hpp"

namespace camdir::scene::q3 {
namespace {

static_assert(sizeof(Shader) == 72 && sizeof(Plane) == 16 && sizeof(Node) == 36 && sizeof(Leaf) == 48);
static_assert(sizeof(Model) == 40 && sizeof(Brush) == 12 && sizeof(BrushSide) == 8 && sizeof(Vertex) == 44);
static_assert(sizeof(Face) == 104);

constexpr std::array<LumpFormat, 17> formats = {{{"entities", 1},
                                                 {"shaders", sizeof(Shader)},
                                                 {"planes", sizeof(Plane)},
                                                 {"nodes", sizeof(Node)},
                                                 {"leaves", sizeof(Leaf)},
                                                 {"leaf faces", 4},
                                                 {"leaf brushes", 4},
                                                 {"models", sizeof(Model)},
                                                 {"brushes", sizeof(Brush)},
                                                 {"sides", sizeof(BrushSide)},
                                                 {"vertices", sizeof(Vertex)},
                                                 {"indices", 4},
                                                 {"fogs", 72},
                                                 {"faces", sizeof(Face)},
                                                 {"lightmaps", 1},
                                                 {"light grid", 1},
                                                 {"visibility", 1}}};
constexpr std::size_t table = 8;
constexpr std::size_t header_size = table + 8 * formats.size();
constexpr std::int32_t max_sides_of_brush = 1024;

Result<Bsp> read_lumps(const Lumps& lumps, std::size_t byte_size) {
    Bsp bsp;
    bsp.byte_size = byte_size;
    const Result<void> done = lumps.read(0, bsp.entities)
                                  .and_then([&] { return lumps.read(1, bsp.shaders); })
                                  .and_then([&] { return lumps.read(2, bsp.planes); })
                                  .and_then([&] { return lumps.read(3, bsp.nodes); })
                                  .and_then([&] { return lumps.read(4, bsp.leaves); })
                                  .and_then([&] { return lumps.read(7, bsp.models); })
                                  .and_then([&] { return lumps.read(8, bsp.brushes); })
                                  .and_then([&] { return lumps.read(9, bsp.brush_sides); })
                                  .and_then([&] { return lumps.read(10, bsp.vertices); })
                                  .and_then([&] { return lumps.read(11, bsp.indices); })
                                  .and_then([&] { return lumps.read(13, bsp.faces); });
    if (!done) return tl::unexpected(done.error());
    return bsp;
}

Result<void> check_planes(const Lumps& lumps, const Bsp& bsp) {
    for (std::size_t i = 0; i < bsp.planes.size(); ++i) {
        if (!is_plane(bsp.planes[i].normal, bsp.planes[i].distance))
            return lumps.bad_element(2, i, "expected a normal of length 1 and a distance below 2^20");
    }
    return {};
}

// Also proves that the nodes form a tree: no node is the child of two others or of itself, and node 0,
// where every descent starts, is no child. Cycles elsewhere cannot be reached.
Result<void> check_nodes(const Lumps& lumps, const Bsp& bsp) {
    if (bsp.nodes.empty()) return lumps.bad_lump(3, "is empty; expected at least one node");
    std::vector<bool> is_child(bsp.nodes.size());
    is_child[0] = true;
    for (std::size_t i = 0; i < bsp.nodes.size(); ++i) {
        if (!in_range(bsp.nodes[i].plane, bsp.planes.size()))
            return lumps.bad_element(3, i, "plane " + std::to_string(bsp.nodes[i].plane) + " does not exist");
        for (const std::int32_t child : bsp.nodes[i].children) {
            const bool exists =
                child < 0 ? in_range(-(child + 1), bsp.leaves.size()) : in_range(child, bsp.nodes.size());
            if (!exists) return lumps.bad_element(3, i, "child " + std::to_string(child) + " does not exist");
            if (child < 0) continue;
            if (is_child[static_cast<std::size_t>(child)])
                return lumps.bad_element(
                    3, i,
                    "child " + std::to_string(child) + " is the root or has another parent; expected a tree");
            is_child[static_cast<std::size_t>(child)] = true;
        }
    }
    return {};
}

Result<void> check_models(const Lumps& lumps, const Bsp& bsp) {
    if (bsp.models.empty()) return lumps.bad_lump(7, "is empty; expected at least the world");
    std::size_t faces = 0;
    std::size_t brushes = 0;
    for (std::size_t i = 0; i < bsp.models.size(); ++i) {
        const Model& model = bsp.models[i];
        if (!is_position(model.mins) || !is_position(model.maxs))
            return lumps.bad_element(7, i, "expected a box of numbers below 2^20");
        if (!in_range(model.first_face, model.face_count, bsp.faces.size()))
            return lumps.bad_element(7, i, "its faces are not all in the file");
        if (!in_range(model.first_brush, model.brush_count, bsp.brushes.size()))
            return lumps.bad_element(7, i, "its brushes are not all in the file");
        faces += static_cast<std::size_t>(model.face_count);
        brushes += static_cast<std::size_t>(model.brush_count);
        if (faces > bsp.faces.size() || brushes > bsp.brushes.size())
            return lumps.bad_element(
                7, i, "shares faces or brushes with another model; expected faces and brushes of its own");
    }
    return {};
}

Result<void> check_brushes(const Lumps& lumps, const Bsp& bsp) {
    std::size_t sides = 0;
    for (std::size_t i = 0; i < bsp.brushes.size(); ++i) {
        const Brush& brush = bsp.brushes[i];
        if (!in_range(brush.shader, bsp.shaders.size()))
            return lumps.bad_element(8, i, "shader " + std::to_string(brush.shader) + " does not exist");
        if (!in_range(brush.first_side, brush.side_count, bsp.brush_sides.size()))
            return lumps.bad_element(8, i, "its sides are not all in the file");
        if (brush.side_count > max_sides_of_brush)
            return lumps.bad_element(8, i,
                                     std::to_string(brush.side_count) + " sides; expected at most " +
                                         std::to_string(max_sides_of_brush));
        sides += static_cast<std::size_t>(brush.side_count);
        if (sides > bsp.brush_sides.size())
            return lumps.bad_element(8, i, "shares sides with another brush; expected sides of its own");
    }
    for (std::size_t i = 0; i < bsp.brush_sides.size(); ++i) {
        if (!in_range(bsp.brush_sides[i].plane, bsp.planes.size()))
            return lumps.bad_element(9, i,
                                     "plane " + std::to_string(bsp.brush_sides[i].plane) + " does not exist");
    }
    return {};
}

Result<void> check_patch(const Lumps& lumps, const Face& face, std::size_t i) {
    const std::int64_t width = face.patch_width;
    const std::int64_t height = face.patch_height;
    if (width < 3 || height < 3 || width % 2 == 0 || height % 2 == 0 || width * height != face.vertex_count)
        return lumps.bad_element(13, i,
                                 "patch of " + std::to_string(width) + " x " + std::to_string(height) +
                                     " with " + std::to_string(face.vertex_count) +
                                     " vertices; expected odd sides of at least 3, and their product");
    return {};
}

Result<void> check_indices(const Lumps& lumps, const Bsp& bsp, const Face& face, std::size_t i) {
    if (face.index_count % 3 != 0)
        return lumps.bad_element(13, i,
                                 std::to_string(face.index_count) + " indices; expected three a triangle");
    for (std::int32_t k = 0; k < face.index_count; ++k) {
        const std::int32_t index = bsp.indices[static_cast<std::size_t>(face.first_index + k)];
        if (!in_range(index, static_cast<std::size_t>(face.vertex_count)))
            return lumps.bad_element(13, i,
                                     "index " + std::to_string(index) + " is not below its " +
                                         std::to_string(face.vertex_count) + " vertices");
    }
    return {};
}

Result<void> check_faces(const Lumps& lumps, const Bsp& bsp) {
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < bsp.faces.size(); ++i) {
        const Face& face = bsp.faces[i];
        if (!in_range(face.shader, bsp.shaders.size()))
            return lumps.bad_element(13, i, "shader " + std::to_string(face.shader) + " does not exist");
        if (!in_range(face.first_vertex, face.vertex_count, bsp.vertices.size()))
            return lumps.bad_element(13, i, "its vertices are not all in the file");
        if (!in_range(face.first_index, face.index_count, bsp.indices.size()))
            return lumps.bad_element(13, i, "its indices are not all in the file");
        if (face.type == triangle_soup) triangles += static_cast<std::size_t>(face.index_count) / 3;
        if (triangles > bsp.max_triangles())
            return lumps.bad_element(13, i,
                                     "the triangle soups up to here have more than " +
                                         std::to_string(bsp.max_triangles()) +
                                         " triangles, which is the limit for a file of this size");
        const Result<void> shape = face.type == patch           ? check_patch(lumps, face, i)
                                   : face.type == triangle_soup ? check_indices(lumps, bsp, face, i)
                                                                : Result<void>();
        if (!shape) return shape;
    }
    return {};
}

Result<void> check_vertices(const Lumps& lumps, const Bsp& bsp) {
    for (std::size_t i = 0; i < bsp.vertices.size(); ++i) {
        if (!is_position(bsp.vertices[i].position))
            return lumps.bad_element(10, i, "expected a position of numbers below 2^20");
    }
    return {};
}

}  // namespace

scene::Plane Bsp::plane(std::int32_t index) const {
    const Plane& plane = planes[static_cast<std::size_t>(index)];
    return to_plane(plane.normal, plane.distance);
}

Result<Bsp> parse_bsp(std::span<const std::byte> bytes) {
    if (bytes.size() < header_size)
        return fail("ends after " + std::to_string(bytes.size()) + " bytes; expected a header of " +
                    std::to_string(header_size));
    std::int32_t version = 0;
    std::memcpy(&version, bytes.data() + 4, sizeof version);
    if (std::memcmp(bytes.data(), "IBSP", 4) != 0 || version != 46)
        return fail("byte 0: expected IBSP and version 46; the version is " + std::to_string(version));
    const Lumps lumps(bytes, table, formats);
    Result<Bsp> bsp = read_lumps(lumps, bytes.size());
    if (!bsp) return bsp;
    const Result<void> checked = check_planes(lumps, *bsp)
                                     .and_then([&] { return check_nodes(lumps, *bsp); })
                                     .and_then([&] { return check_models(lumps, *bsp); })
                                     .and_then([&] { return check_brushes(lumps, *bsp); })
                                     .and_then([&] { return check_vertices(lumps, *bsp); })
                                     .and_then([&] { return check_faces(lumps, *bsp); });
    if (!checked) return tl::unexpected(checked.error());
    return bsp;
}

}  // namespace camdir::scene::q3
