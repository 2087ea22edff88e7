#include "scene/q3_bsp.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace camdir::scene::q3 {
namespace {

static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(Shader) == 72 && sizeof(Plane) == 16 && sizeof(Node) == 36 && sizeof(Leaf) == 48);
static_assert(sizeof(Model) == 40 && sizeof(Brush) == 12 && sizeof(BrushSide) == 8 && sizeof(Vertex) == 44);
static_assert(sizeof(Face) == 104);

constexpr std::size_t lump_count = 17;
constexpr std::size_t header_size = 8 + 8 * lump_count;
constexpr float max_coordinate = 1 << 20;
constexpr std::int32_t max_sides_of_brush = 1024;

constexpr std::array<const char*, lump_count> lump_names = {
    "entities",     "shaders", "planes",    "nodes",      "leaves",    "leaf faces",
    "leaf brushes", "models",  "brushes",   "sides",      "vertices",  "indices",
    "fogs",         "faces",   "lightmaps", "light grid", "visibility"};

std::string in_lump(std::size_t lump) {
    return "lump " + std::to_string(lump) + " (" + lump_names[lump] + "): ";
}

tl::unexpected<Error> bad_element(std::size_t lump, std::size_t element, const std::string& what) {
    return fail(in_lump(lump) + "element " + std::to_string(element) + ": " + what);
}

class Lumps {
  public:
    explicit Lumps(std::span<const std::byte> bytes) : bytes_(bytes) {}

    // Copies a lump's elements; T may be char, for text.
    template <class Container>
    [[nodiscard]] Result<void> read(std::size_t lump, Container& to) const {
        using Element = typename Container::value_type;
        static_assert(std::is_trivially_copyable_v<Element>);
        std::array<std::int32_t, 2> place;
        std::memcpy(place.data(), bytes_.data() + 8 + 8 * lump, sizeof place);
        const auto [offset, length] = place;
        if (offset < 0 || length < 0 || static_cast<std::size_t>(offset) > bytes_.size() ||
            static_cast<std::size_t>(length) > bytes_.size() - static_cast<std::size_t>(offset))
            return fail(in_lump(lump) + "bytes " + std::to_string(offset) + " to " +
                        std::to_string(std::int64_t{offset} + length) + " are not in the file of " +
                        std::to_string(bytes_.size()) + " bytes");
        if (static_cast<std::size_t>(length) % sizeof(Element) != 0)
            return fail(in_lump(lump) + "length " + std::to_string(length) + " is no multiple of " +
                        std::to_string(sizeof(Element)));
        to.resize(static_cast<std::size_t>(length) / sizeof(Element));
        if (length > 0) std::memcpy(to.data(), bytes_.data() + offset, static_cast<std::size_t>(length));
        return {};
    }

  private:
    std::span<const std::byte> bytes_;
};

Result<Bsp> read_lumps(std::span<const std::byte> bytes) {
    const Lumps lumps(bytes);
    Bsp bsp;
    bsp.byte_size = bytes.size();
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

bool in_range(std::int32_t index, std::size_t size) {
    return index >= 0 && static_cast<std::size_t>(index) < size;
}

bool in_range(std::int32_t first, std::int32_t count, std::size_t size) {
    return first >= 0 && count >= 0 && std::int64_t{first} + count <= static_cast<std::int64_t>(size);
}

bool is_coordinate(float value) {
    return std::abs(value) < max_coordinate;  // false for NaN
}

bool is_position(const std::array<float, 3>& p) {
    return is_coordinate(p[0]) && is_coordinate(p[1]) && is_coordinate(p[2]);
}

Result<void> check_planes(const Bsp& bsp) {
    for (std::size_t i = 0; i < bsp.planes.size(); ++i) {
        const Plane& plane = bsp.planes[i];
        const auto& n = plane.normal;
        const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        if (!(std::abs(length - 1.0F) < 0.01F) || !is_coordinate(plane.distance))
            return bad_element(2, i, "expected a normal of length 1 and a distance below 2^20");
    }
    return {};
}

// Also proves that the nodes form a tree: no node is the child of two others or of itself, and node 0,
// where every descent starts, is nobody's child. What such a graph keeps as a cycle cannot be reached.
Result<void> check_nodes(const Bsp& bsp) {
    if (bsp.nodes.empty()) return fail(in_lump(3) + "is empty; expected at least one node");
    std::vector<bool> is_child(bsp.nodes.size());
    is_child[0] = true;
    for (std::size_t i = 0; i < bsp.nodes.size(); ++i) {
        if (!in_range(bsp.nodes[i].plane, bsp.planes.size()))
            return bad_element(3, i, "plane " + std::to_string(bsp.nodes[i].plane) + " does not exist");
        for (const std::int32_t child : bsp.nodes[i].children) {
            const bool exists =
                child < 0 ? in_range(-(child + 1), bsp.leaves.size()) : in_range(child, bsp.nodes.size());
            if (!exists) return bad_element(3, i, "child " + std::to_string(child) + " does not exist");
            if (child < 0) continue;
            if (is_child[static_cast<std::size_t>(child)])
                return bad_element(
                    3, i,
                    "child " + std::to_string(child) + " is the root or has another parent; expected a tree");
            is_child[static_cast<std::size_t>(child)] = true;
        }
    }
    return {};
}

Result<void> check_models(const Bsp& bsp) {
    if (bsp.models.empty()) return fail(in_lump(7) + "is empty; expected at least the world");
    for (std::size_t i = 0; i < bsp.models.size(); ++i) {
        const Model& model = bsp.models[i];
        if (!is_position(model.mins) || !is_position(model.maxs))
            return bad_element(7, i, "expected a box of numbers below 2^20");
        if (!in_range(model.first_face, model.face_count, bsp.faces.size()))
            return bad_element(7, i, "its faces are not all in the file");
        if (!in_range(model.first_brush, model.brush_count, bsp.brushes.size()))
            return bad_element(7, i, "its brushes are not all in the file");
    }
    return {};
}

Result<void> check_brushes(const Bsp& bsp) {
    std::size_t sides = 0;
    for (std::size_t i = 0; i < bsp.brushes.size(); ++i) {
        const Brush& brush = bsp.brushes[i];
        if (!in_range(brush.shader, bsp.shaders.size()))
            return bad_element(8, i, "shader " + std::to_string(brush.shader) + " does not exist");
        if (!in_range(brush.first_side, brush.side_count, bsp.brush_sides.size()))
            return bad_element(8, i, "its sides are not all in the file");
        if (brush.side_count > max_sides_of_brush)
            return bad_element(8, i,
                               std::to_string(brush.side_count) + " sides; expected at most " +
                                   std::to_string(max_sides_of_brush));
        sides += static_cast<std::size_t>(brush.side_count);
        if (sides > bsp.brush_sides.size())
            return bad_element(8, i, "shares sides with another brush; expected sides of its own");
    }
    for (std::size_t i = 0; i < bsp.brush_sides.size(); ++i) {
        if (!in_range(bsp.brush_sides[i].plane, bsp.planes.size()))
            return bad_element(9, i, "plane " + std::to_string(bsp.brush_sides[i].plane) + " does not exist");
    }
    return {};
}

Result<void> check_patch(const Face& face, std::size_t i) {
    const std::int64_t width = face.patch_width;
    const std::int64_t height = face.patch_height;
    if (width < 3 || height < 3 || width % 2 == 0 || height % 2 == 0 || width * height != face.vertex_count)
        return bad_element(13, i,
                           "patch of " + std::to_string(width) + " x " + std::to_string(height) + " with " +
                               std::to_string(face.vertex_count) +
                               " vertices; expected odd sides of at least 3, and their product");
    return {};
}

Result<void> check_indices(const Bsp& bsp, const Face& face, std::size_t i) {
    if (face.index_count % 3 != 0)
        return bad_element(13, i, std::to_string(face.index_count) + " indices; expected three a triangle");
    for (std::int32_t k = 0; k < face.index_count; ++k) {
        const std::int32_t index = bsp.indices[static_cast<std::size_t>(face.first_index + k)];
        if (!in_range(index, static_cast<std::size_t>(face.vertex_count)))
            return bad_element(13, i,
                               "index " + std::to_string(index) + " is not below its " +
                                   std::to_string(face.vertex_count) + " vertices");
    }
    return {};
}

Result<void> check_faces(const Bsp& bsp) {
    std::size_t triangles = 0;
    for (std::size_t i = 0; i < bsp.faces.size(); ++i) {
        const Face& face = bsp.faces[i];
        if (!in_range(face.shader, bsp.shaders.size()))
            return bad_element(13, i, "shader " + std::to_string(face.shader) + " does not exist");
        if (!in_range(face.first_vertex, face.vertex_count, bsp.vertices.size()))
            return bad_element(13, i, "its vertices are not all in the file");
        if (!in_range(face.first_index, face.index_count, bsp.indices.size()))
            return bad_element(13, i, "its indices are not all in the file");
        if (face.type == triangle_soup) triangles += static_cast<std::size_t>(face.index_count) / 3;
        if (triangles > bsp.max_triangles())
            return bad_element(13, i,
                               "the triangle soups up to here have more than " +
                                   std::to_string(bsp.max_triangles()) +
                                   " triangles, which is the limit for a file of this size");
        const Result<void> shape = face.type == patch           ? check_patch(face, i)
                                   : face.type == triangle_soup ? check_indices(bsp, face, i)
                                                                : Result<void>();
        if (!shape) return shape;
    }
    return {};
}

Result<void> check_vertices(const Bsp& bsp) {
    for (std::size_t i = 0; i < bsp.vertices.size(); ++i) {
        if (!is_position(bsp.vertices[i].position))
            return bad_element(10, i, "expected a position of numbers below 2^20");
    }
    return {};
}

}  // namespace

Result<Bsp> parse_bsp(std::span<const std::byte> bytes) {
    if (bytes.size() < header_size)
        return fail("ends after " + std::to_string(bytes.size()) + " bytes; expected a header of " +
                    std::to_string(header_size));
    std::int32_t version = 0;
    std::memcpy(&version, bytes.data() + 4, sizeof version);
    if (std::memcmp(bytes.data(), "IBSP", 4) != 0 || version != 46)
        return fail("byte 0: expected IBSP and version 46; the version is " + std::to_string(version));
    Result<Bsp> bsp = read_lumps(bytes);
    if (!bsp) return bsp;
    const Result<void> checked = check_planes(*bsp)
                                     .and_then([&] { return check_nodes(*bsp); })
                                     .and_then([&] { return check_models(*bsp); })
                                     .and_then([&] { return check_brushes(*bsp); })
                                     .and_then([&] { return check_vertices(*bsp); })
                                     .and_then([&] { return check_faces(*bsp); });
    if (!checked) return tl::unexpected(checked.error());
    return bsp;
}

}  // namespace camdir::scene::q3
