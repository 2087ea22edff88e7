#include "bake/triangulate.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <tuple>

#include "base/parallel.hpp"

namespace camdir::bake {
namespace {

// Cotangent of the angle under which the edge a-b is seen from p; it falls as the angle grows.
double cotangent(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
    const Vec3d to_a = a - p;
    const Vec3d to_b = b - p;
    return to_a.dot(to_b) / to_a.cross(to_b).norm();
}

// Positions first < ... < last of the polygon: the part beyond the edge first-last.
struct Part {
    std::uint32_t first, last;
};

// In the Delaunay triangulation of a convex polygon the third corner of an edge is the one that sees it under
// the widest angle.
std::uint32_t third_corner(std::span<const Vec3d> polygon, const Part& part) {
    std::uint32_t best = part.first + 1;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = part.first + 1; k < part.last; ++k) {
        const double value = cotangent(polygon[part.first], polygon[part.last], polygon[k]);
        if (value < smallest) {
            smallest = value;
            best = k;
        }
    }
    return best;
}

// No area: a repeated corner, or corners in one line as far as floats can tell.
bool degenerate(const MedialMesh& mesh, const freespace::Triangle& t) {
    if (t.a == t.b || t.b == t.c || t.c == t.a) return true;
    const Triangle3d corners = mesh.corners(t);
    const Vec3d u = corners[1] - corners[0];
    const Vec3d v = corners[2] - corners[0];
    return !(u.cross(v).squaredNorm() > 1e-24 * u.squaredNorm() * v.squaredNorm());
}

// Keeps the first of those with the same corners: neighbouring faces may end in one merged vertex.
void drop_repeated(MedialMesh& mesh) {
    struct Entry {
        std::array<std::uint32_t, 3> corners;  // ascending
        std::size_t position;
    };
    std::vector<Entry> entries;
    entries.reserve(mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        entries.push_back({{a, b, c}, entries.size()});
        std::sort(entries.back().corners.begin(), entries.back().corners.end());
    }
    parallel_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::tie(a.corners, a.position) < std::tie(b.corners, b.position);
    });
    std::vector<char> keep(entries.size(), 1);
    for (std::size_t i = 1; i < entries.size(); ++i)
        keep[entries[i].position] = entries[i].corners != entries[i - 1].corners;
    keep_triangles(mesh, keep);
}

}  // namespace

void triangulate_convex(std::span<const Vec3d> polygon,
                        std::vector<std::array<std::uint32_t, 3>>& triangles) {
    assert(polygon.size() >= 3);
    std::vector<Part> parts{{0, static_cast<std::uint32_t>(polygon.size()) - 1}};
    while (!parts.empty()) {
        const Part part = parts.back();
        parts.pop_back();
        if (part.last - part.first < 2) continue;
        const std::uint32_t third = third_corner(polygon, part);
        triangles.push_back({part.first, third, part.last});
        parts.push_back({third, part.last});
        parts.push_back({part.first, third});
    }
}

Result<MedialMesh> triangulate(const VoronoiFaces& faces, Stage& stage) {
    MedialMesh mesh;
    mesh.vertices.reserve(faces.vertices.size());
    for (const Vec3d& p : faces.vertices)
        mesh.vertices.push_back(p.cast<float>());

    std::vector<Vec3d> polygon;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (i % 4096 == 0 && !stage.advance(i, faces.size())) return stage.interrupted();
        const auto face = faces.face(i);
        polygon.clear();
        triangles.clear();
        for (const std::uint32_t corner : face)
            polygon.push_back(faces.vertices[corner]);
        triangulate_convex(polygon, triangles);
        for (const auto& [a, b, c] : triangles) {
            const freespace::Triangle triangle{face[a], face[b], face[c]};
            if (!degenerate(mesh, triangle)) mesh.triangles.push_back(triangle);
        }
    }
    drop_repeated(mesh);
    stage.count("triangles", static_cast<double>(mesh.triangles.size()));
    return mesh;
}

}  // namespace camdir::bake
