#include "bench/paper/constant_distance.hpp"

#include <algorithm>
#include <cassert>
#include <limits>

#include "base/round_down.hpp"

namespace camdir::paper {

// Triangles are in the order of their faces.
std::vector<std::uint32_t> faces_of(const bake::MedialMesh& mesh, const bake::VoronoiFaces& faces) {
    std::vector<std::uint32_t> face_of;
    face_of.reserve(mesh.triangles.size());
    std::uint32_t face = 0;
    const auto has = [&](std::uint32_t vertex) {
        const auto corners = faces.face(face);
        return std::find(corners.begin(), corners.end(), vertex) != corners.end();
    };
    for (const freespace::Triangle& t : mesh.triangles) {
        while (!(has(t.a) && has(t.b) && has(t.c))) {
            ++face;
            assert(face < faces.size());
        }
        face_of.push_back(face);
    }
    return face_of;
}

std::vector<float> constant_distances(const bake::MedialMesh& mesh, const std::vector<std::uint32_t>& face_of,
                                      const std::vector<double>& generator_distance, double d0) {
    constexpr double unset = std::numeric_limits<double>::infinity();
    std::vector<double> least(mesh.vertices.size(), unset);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const double distance = generator_distance[face_of[i]] / 2.0 - d0;
        const freespace::Triangle& t = mesh.triangles[i];
        for (const std::uint32_t vertex : {t.a, t.b, t.c})
            least[vertex] = std::min(least[vertex], distance);
    }
    std::vector<float> distances;
    distances.reserve(least.size());
    for (const double distance : least)
        distances.push_back(distance == unset ? 0.0F : round_down(distance));
    return distances;
}

}  // namespace camdir::paper
