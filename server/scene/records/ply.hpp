// PLY: ascii, binary_little_endian and binary_big_endian.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "scene/records/records.hpp"

namespace camdir::scene {

[[nodiscard]] bool is_ply(std::span<const std::byte> bytes);

// How many faces or triangle strips the header declares; 0 for a point cloud.
[[nodiscard]] Result<std::uint64_t> ply_face_count(std::span<const std::byte> bytes);

// The rows of the element `vertex`. Views into the bytes.
struct PlyVertices {
    std::uint64_t count;
    bool is_text, big_endian;
    std::array<std::size_t, 3> places;  // of x, y and z among the row's numbers
    Lines lines;                        // before the first row
    Columns columns;                    // offsets in the file; of text only the types are set
};

// All rows of a binary file are in it. Errors name the line or the byte.
[[nodiscard]] Result<PlyVertices> find_ply_vertices(std::span<const std::byte> bytes);

// The positions of the element `vertex`, in the file's order. Errors name the line or the byte.
[[nodiscard]] Result<std::vector<Vec3d>> read_ply_points(std::span<const std::byte> bytes);

// Takes the vertices of a face, or of a triangle strip, in which -1 begins another.
using PlyFaceVisitor = std::function<void(const std::vector<std::int64_t>&, bool is_strip)>;

// All faces and triangle strips, in the file's order; fails where a row is incomplete, or names a vertex that
// is not one of `vertices`.
[[nodiscard]] Result<void> visit_ply_faces(std::span<const std::byte> bytes, std::uint64_t vertices,
                                           const PlyFaceVisitor& visit);

}  // namespace camdir::scene
