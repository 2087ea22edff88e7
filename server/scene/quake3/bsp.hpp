// A Quake 3 BSP file (IBSP, version 46) as it is on disk: its lumps, with every index checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::scene::q3 {

inline constexpr std::int32_t contents_solid = 1;
inline constexpr std::int32_t contents_liquid = 8 | 16 | 32;  // lava, slime, water
inline constexpr std::int32_t contents_fog = 64;
inline constexpr std::int32_t contents_clip = 0x10000 | 0x20000;  // of players, of monsters
inline constexpr std::int32_t surface_sky = 4;

// The structures below have the layout of the file: little-endian, no padding.
struct Shader {
    std::array<char, 64> name;
    std::int32_t surface_flags;
    std::int32_t contents;
};
struct Plane {
    std::array<float, 3> normal;
    float distance;
};
struct Node {
    std::int32_t plane;
    std::array<std::int32_t, 2> children;  // front, back; negative: leaf -(child + 1)
    std::array<std::int32_t, 6> box;
};
struct Leaf {
    std::int32_t cluster;  // < 0: not part of the playable world
    std::array<std::int32_t, 11> rest;
};
struct Model {
    std::array<float, 3> mins, maxs;
    std::int32_t first_face, face_count;
    std::int32_t first_brush, brush_count;
};
struct Brush {
    std::int32_t first_side, side_count;
    std::int32_t shader;
};
struct BrushSide {
    std::int32_t plane;
    std::int32_t shader;
};
struct Vertex {
    std::array<float, 3> position;
    std::array<std::byte, 32> rest;
};
enum FaceType : std::int32_t { planar = 1, patch = 2, triangle_soup = 3, flare = 4 };
struct Face {
    std::int32_t shader, effect, type;
    std::int32_t first_vertex, vertex_count;
    std::int32_t first_index, index_count;  // of `indices`, which count from first_vertex
    std::array<std::int32_t, 14> lightmap;
    std::array<float, 3> normal;
    std::int32_t patch_width, patch_height;
};

struct Bsp {
    std::size_t byte_size;
    std::string entities;
    std::vector<Shader> shaders;
    std::vector<Plane> planes;
    std::vector<Node> nodes;
    std::vector<Leaf> leaves;
    std::vector<Model> models;
    std::vector<Brush> brushes;
    std::vector<BrushSide> brush_sides;
    std::vector<Vertex> vertices;
    std::vector<std::int32_t> indices;
    std::vector<Face> faces;

    [[nodiscard]] scene::Plane plane(std::int32_t index) const;

    // Limit of the triangles that soups, and patches when tessellated, may come to: faces may share vertices
    // and a patch of nine may be huge, but memory stays in proportion to the file. Real maps stay below a
    // tenth.
    [[nodiscard]] std::size_t max_triangles() const { return 65536 + byte_size / 4; }
};

// Afterwards: every reference between lumps is in range, the nodes form a tree with its root at 0,
// brushes have no more sides, and models no more brushes and faces, in all than the file has, numbers of
// planes, vertices and models are finite and below 2^20 in size, plane normals have length 1 within 1 %,
// there is at least one model. Errors name lump and element.
[[nodiscard]] Result<Bsp> parse_bsp(std::span<const std::byte> bytes);

}  // namespace camdir::scene::q3
