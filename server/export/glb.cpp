#include "export/glb.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "freespace/roadmap.hpp"
#include "render/colour.hpp"

namespace camdir::exports {
namespace {

using freespace::Freespace;
using nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF is written in the order of memory");

// Constants of the glTF 2.0 specification.
constexpr int type_float = 5126;
constexpr int type_uint = 5125;
constexpr int type_ubyte = 5121;
constexpr int type_ushort = 5123;
constexpr int array_buffer = 34962;
constexpr int element_array_buffer = 34963;
constexpr int mode_lines = 1;
constexpr int mode_triangles = 4;
constexpr std::uint32_t magic = 0x46546c67;
constexpr std::uint32_t json_chunk = 0x4e4f534a;
constexpr std::uint32_t binary_chunk = 0x004e4942;
constexpr double max_ushort = 65535.0;
constexpr double half_root = 0.70710678118654752;

void append(Bytes& bytes, std::uint32_t value) {
    const auto raw = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

// The document and its one buffer.
class Document {
  public:
    // Adds the values as a buffer view with one accessor; returns the accessor's index.
    template <class Value>
    std::size_t add_accessor(const std::vector<Value>& values, int component, const char* type, int target) {
        const auto raw = std::as_bytes(std::span(values));
        const std::size_t offset = buffer_.size();
        buffer_.insert(buffer_.end(), raw.begin(), raw.end());  // every Value has a multiple of 4 bytes
        json_["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", raw.size()}, {"target", target}});
        json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                      {"componentType", component},
                                      {"count", values.size()},
                                      {"type", type}});
        return json_["accessors"].size() - 1;
    }

    ordered_json& accessor(std::size_t index) { return json_["accessors"][index]; }

    // Adds a mesh of one primitive and a node for it; returns the node's index.
    std::size_t add_mesh(const std::string& name, ordered_json primitive) {
        json_["meshes"].push_back(
            {{"name", name}, {"primitives", ordered_json::array({std::move(primitive)})}});
        return add_node({{"name", name}, {"mesh", json_["meshes"].size() - 1}});
    }

    std::size_t add_node(ordered_json node) {
        json_["nodes"].push_back(std::move(node));
        return json_["nodes"].size() - 1;
    }

    ordered_json& json() { return json_; }

    [[nodiscard]] Result<Bytes> file() &&;

  private:
    ordered_json json_{{"asset", {{"version", "2.0"}, {"generator", "camera-director"}}}};
    Bytes buffer_;
};

Result<Bytes> Document::file() && {
    if (!buffer_.empty()) json_["buffers"] = {{{"byteLength", buffer_.size()}}};
    // Names of files may hold any bytes; JSON is UTF-8.
    std::string text = json_.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t length = 12 + 8 + text.size() + (buffer_.empty() ? 0 : 8 + buffer_.size());
    if (length > std::numeric_limits<std::uint32_t>::max()) return fail("larger than glTF's limit of 4 GB");
    Bytes file;
    file.reserve(length);
    for (const std::uint32_t word :
         {magic, 2U, static_cast<std::uint32_t>(length), static_cast<std::uint32_t>(text.size()), json_chunk})
        append(file, word);
    const auto raw = std::as_bytes(std::span(text));
    file.insert(file.end(), raw.begin(), raw.end());
    if (buffer_.empty()) return file;
    append(file, static_cast<std::uint32_t>(buffer_.size()));
    append(file, binary_chunk);
    file.insert(file.end(), buffer_.begin(), buffer_.end());
    return file;
}

// glTF's vertex colours are linear.
std::uint8_t linear(float srgb) {
    const float value = srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F);
    return static_cast<std::uint8_t>(std::lround(value * 255.0F));
}

float largest_free_distance(const Freespace& freespace) {
    float largest = 1e-3F;
    for (const freespace::Vertex& vertex : freespace.vertices())
        largest = std::max(largest, vertex.free_distance);
    return largest;
}

// The attributes that triangles and roadmap share.
ordered_json add_vertices(Document& document, const Freespace& freespace) {
    using Point = std::array<float, 3>;
    std::vector<Point> positions;
    std::vector<float> distances;
    std::vector<std::array<std::uint8_t, 4>> colours;
    const float largest = largest_free_distance(freespace);
    for (const freespace::Vertex& vertex : freespace.vertices()) {
        positions.push_back({vertex.x, vertex.y, vertex.z});
        distances.push_back(vertex.free_distance);
        const render::Colour colour = render::colour_scale(vertex.free_distance / largest);
        colours.push_back({linear(colour.red), linear(colour.green), linear(colour.blue), 255});
    }
    Point min = positions.front();
    Point max = positions.front();
    for (const Point& position : positions) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            min[axis] = std::min(min[axis], position[axis]);
            max[axis] = std::max(max[axis], position[axis]);
        }
    }
    const std::size_t position = document.add_accessor(positions, type_float, "VEC3", array_buffer);
    document.accessor(position)["min"] = min;
    document.accessor(position)["max"] = max;
    const std::size_t colour = document.add_accessor(colours, type_ubyte, "VEC4", array_buffer);
    document.accessor(colour)["normalized"] = true;
    const std::size_t distance = document.add_accessor(distances, type_float, "SCALAR", array_buffer);
    return {{"POSITION", position}, {"COLOR_0", colour}, {"_FREE_DISTANCE", distance}};
}

std::size_t add_indexed(Document& document, const std::string& name, const ordered_json& attributes,
                        const std::vector<std::uint32_t>& indices, int mode) {
    const std::size_t accessor = document.add_accessor(indices, type_uint, "SCALAR", element_array_buffer);
    return document.add_mesh(
        name, {{"attributes", attributes}, {"indices", accessor}, {"material", 0}, {"mode", mode}});
}

std::vector<std::size_t> add_meshes(Document& document, const Freespace& freespace) {
    if (freespace.triangles().empty()) return {};
    // Unlit: the colours encode free distance and must not be shaded.
    document.json()["extensionsUsed"] = {"KHR_materials_unlit"};
    document.json()["materials"] = {{{"name", "free distance"},
                                     {"doubleSided", true},
                                     {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                                     {"extensions", {{"KHR_materials_unlit", ordered_json::object()}}}}};
    const ordered_json attributes = add_vertices(document, freespace);
    std::vector<std::uint32_t> corners;
    for (const auto& [a, b, c] : freespace.triangles())
        corners.insert(corners.end(), {a, b, c});
    std::vector<std::size_t> nodes{add_indexed(document, "medial mesh", attributes, corners, mode_triangles)};
    std::vector<std::uint32_t> ends;
    for (const freespace::RoadmapEdge& edge : freespace::roadmap_edges(freespace))
        ends.insert(ends.end(), edge.begin(), edge.end());
    if (!ends.empty()) nodes.push_back(add_indexed(document, "roadmap", attributes, ends, mode_lines));
    return nodes;
}

std::size_t add_spawn_point(Document& document, const freespace::SpawnPoint& spawn, std::size_t number) {
    const double half = static_cast<double>(spawn.yaw) * 0.5;
    return document.add_node({{"name", "spawn point " + std::to_string(number)},
                              {"translation", {spawn.eye.x(), spawn.eye.y(), spawn.eye.z()}},
                              {"rotation", {0.0, 0.0, std::sin(half), std::cos(half)}}});
}

// The scene's one root, in map units with z up.
void add_root(Document& document, const std::string& name, double metres,
              const std::vector<std::size_t>& children) {
    // From z up to y up: (x, y, z) becomes (x, z, -y).
    ordered_json root{
        {"name", name}, {"rotation", {-half_root, 0.0, 0.0, half_root}}, {"scale", {metres, metres, metres}}};
    if (!children.empty()) root["children"] = children;
    const std::size_t root_number = document.add_node(std::move(root));
    document.json()["scenes"] = {{{"nodes", {root_number}}}};
    document.json()["scene"] = 0;
}

Box3d vertex_bounds(const scene::Scene& scene) {
    Box3d box;
    for (const Vec3d& vertex : scene.vertices)
        box.extend(vertex);
    return box;
}

// A scale of 0 would make the node's matrix singular.
Vec3d quantisation_step(const Box3d& box) {
    return (box.sizes() / max_ushort).cwiseMax(1e-9);
}

std::size_t add_quantised_positions(Document& document, const scene::Scene& scene, const Box3d& box) {
    // Four, for vertices have a multiple of 4 bytes.
    using Position = std::array<std::uint16_t, 4>;
    const Vec3d step = quantisation_step(box);
    std::vector<Position> positions;
    Position max{};
    for (const Vec3d& vertex : scene.vertices) {
        const Vec3d steps = (vertex - box.min()).cwiseQuotient(step);
        Position position{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            position[axis] = static_cast<std::uint16_t>(std::lround(steps[static_cast<Eigen::Index>(axis)]));
            max[axis] = std::max(max[axis], position[axis]);
        }
        positions.push_back(position);
    }
    const std::size_t accessor = document.add_accessor(positions, type_ushort, "VEC3", array_buffer);
    document.json()["bufferViews"].back()["byteStride"] = sizeof(Position);
    document.accessor(accessor)["min"] = {0, 0, 0};
    document.accessor(accessor)["max"] = {max[0], max[1], max[2]};
    return accessor;
}

}  // namespace

Result<Bytes> to_glb(const Freespace& freespace) {
    Document document;
    std::vector<std::size_t> children = add_meshes(document, freespace);
    std::size_t number = 0;
    for (const freespace::SpawnPoint& spawn : freespace.spawn_points())
        children.push_back(add_spawn_point(document, spawn, number++));
    add_root(document, freespace.metadata().map_name, freespace.metadata().metres_per_unit, children);
    return std::move(document).file();
}

Result<Bytes> to_glb(const scene::Scene& scene) {
    if (scene.triangles.empty()) return fail(scene.name + ": no triangles to export");
    Document document;
    document.json()["extensionsUsed"] = {"KHR_mesh_quantization"};
    document.json()["extensionsRequired"] = {"KHR_mesh_quantization"};
    document.json()["materials"] = {{{"name", "obstacles"}}};
    const Box3d box = vertex_bounds(scene);
    const ordered_json attributes{{"POSITION", add_quantised_positions(document, scene, box)}};
    std::vector<std::uint32_t> corners;
    for (const auto& triangle : scene.triangles)
        corners.insert(corners.end(), triangle.begin(), triangle.end());
    const std::size_t node = add_indexed(document, "obstacles", attributes, corners, mode_triangles);
    const Vec3d step = quantisation_step(box);
    document.json()["nodes"][node]["translation"] = {box.min().x(), box.min().y(), box.min().z()};
    document.json()["nodes"][node]["scale"] = {step.x(), step.y(), step.z()};
    add_root(document, scene.name, scene.metres_per_unit, {node});
    return std::move(document).file();
}

}  // namespace camdir::exports
