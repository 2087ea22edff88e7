// A BSP file of Quake (version 29) or GoldSrc (version 30) as it is on disk: its lumps, with every index
// checked. What is read here is the same in both.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::scene::quake {

inline constexpr std::int32_t version_quake = 29;
inline constexpr std::int32_t version_goldsrc = 30;

// The structures below have the layout of the file: little-endian, no padding.
struct Plane {
    std::array<float, 3> normal;
    float distance;
    std::int32_t type;
};
struct Vertex {
    std::array<float, 3> position;
};
struct Node {
    std::int32_t plane;
    std::array<std::uint16_t, 2> children;  // front, back; see child_of
    std::array<std::int16_t, 6> box;
    std::uint16_t first_face, face_count;
};
struct TextureInfo {
    std::array<float, 8> axes;
    std::int32_t texture;
    std::int32_t flags;
};
struct Face {
    std::uint16_t plane;
    std::uint16_t side;       // not 0: the face looks against the plane's normal
    std::int32_t first_edge;  // of `surface_edges`
    std::uint16_t edge_count;
    std::uint16_t texture_info;
    std::array<std::uint8_t, 4> styles;
    std::int32_t light;
};
enum Contents : std::int32_t { empty = -1, solid = -2, sky = -6 };
struct Leaf {
    std::int32_t contents;
    std::array<std::int32_t, 6> rest;
};
struct Edge {
    std::array<std::uint16_t, 2> vertices;
};
struct Model {
    std::array<float, 3> mins, maxs, origin;
    std::array<std::int32_t, 4> head_nodes;  // [0]: root of its tree, or -(leaf + 1)
    std::int32_t visible_leaves;
    std::int32_t first_face, face_count;
};

struct Bsp {
    std::size_t byte_size;
    std::int32_t version;
    std::string entities;
    std::vector<Plane> planes;
    std::vector<std::string> textures;  // their names
    std::vector<Vertex> vertices;
    std::vector<Node> nodes;
    std::vector<TextureInfo> texture_infos;
    std::vector<Face> faces;
    std::vector<Leaf> leaves;
    std::vector<Edge> edges;
    std::vector<std::int32_t> surface_edges;  // negative: the edge -n from its second vertex to its first
    std::vector<Model> models;

    // A node's child: a node, or -(leaf + 1). The file counts leaves down from 65535, which allows more than
    // 32767 nodes.
    [[nodiscard]] std::int32_t child_of(const Node& node, std::size_t side) const;

    [[nodiscard]] scene::Plane plane(std::int32_t index) const;

    // Limit of the planes around the volumes of solid leaves, which the file does not bound by itself. Real
    // maps stay below a tenth.
    [[nodiscard]] std::size_t max_volume_planes() const { return 65536 + byte_size; }

    // Limit of the nodes and leaves that the faces of solid leaves are taken through to find the surface: all
    // could cut each. Real maps stay below a tenth.
    [[nodiscard]] std::size_t max_surface_steps() const { return 65536 + byte_size; }
};

// Afterwards: all lumps are inside the file, every reference between those read is in range, no node has two
// parents and no model's root has one, no two models have the same root, faces have no more surface edges,
// and models no more faces, in all than the file has, numbers of planes, vertices and models are finite and
// below 2^20 in size, plane normals have length 1 within 1 %, there is at least one model. Errors name lump,
// element and byte.
[[nodiscard]] Result<Bsp> parse_bsp(std::span<const std::byte> bytes);

}  // namespace camdir::scene::quake
