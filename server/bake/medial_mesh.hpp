// The medial mesh V(S) under construction: the paper's section 4.2.
#pragma once

#include <cstdint>
#include <vector>

#include "bake/geometry/triangle.hpp"
#include "freespace/freespace.hpp"

namespace camdir::bake {

// Vertices are floats, as in a freespace: all later stages compute with the rounded positions.
struct MedialMesh {
    std::vector<Vec3f> vertices;
    std::vector<freespace::Triangle> triangles;

    [[nodiscard]] Vec3d position(std::uint32_t vertex) const { return vertices[vertex].cast<double>(); }
    [[nodiscard]] Triangle3d corners(const freespace::Triangle& t) const {
        return {position(t.a), position(t.b), position(t.c)};
    }
};

// Removes the triangles with keep[i] == 0.
void keep_triangles(MedialMesh& mesh, const std::vector<char>& keep);

}  // namespace camdir::bake
