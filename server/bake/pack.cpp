#include "bake/pack.hpp"

#include <algorithm>
#include <utility>

#include "bake/geometry/certificate.hpp"

namespace camdir::bake {
namespace {

bool covered(const Vec3d& point, const freespace::Contents& contents) {
    const auto holds = [&](const freespace::Triangle& t) {
        Triangle3d corners;
        std::array<double, 3> free_distance;
        const std::array<std::uint32_t, 3> ids{t.a, t.b, t.c};
        for (int i = 0; i < 3; ++i) {
            corners[i] = contents.vertices[ids[i]].position().cast<double>();
            free_distance[i] = contents.vertices[ids[i]].free_distance;
        }
        const Slab slab(corners, free_distance);
        const Triangle3d as_obstacle{point, point, point};
        return slab.min_gap(as_obstacle) < 0.0 && slab.signed_gap(as_obstacle).value < 0.0;
    };
    return std::any_of(contents.triangles.begin(), contents.triangles.end(), holds);
}

// The centre of the widest ball within the map's bounds: balls above and around an open map are wider but
// reach out of them. Where none is within, that of the widest after clipping to the bounds.
freespace::SpawnPoint widest_place(const freespace::Contents& contents, const Box3d& bounds) {
    const auto width = [&](const freespace::Vertex& vertex) {
        const double radius = vertex.free_distance;
        const double depth = depth_in(bounds, vertex.position().cast<double>());
        return std::pair(radius <= depth ? radius : 0.0, std::min(radius, depth));
    };
    const auto widest = std::max_element(contents.vertices.begin(), contents.vertices.end(),
                                         [&](const auto& a, const auto& b) { return width(a) < width(b); });
    return {widest->position(), 0.0F};
}

}  // namespace

Result<freespace::Contents> pack(const MedialMesh& mesh, const std::vector<float>& free_distance,
                                 const scene::Scene& scene, Stage& stage) {
    freespace::Contents contents;
    std::vector<std::uint32_t> new_index(mesh.vertices.size(), freespace::none);
    const double threshold = min_free_distance * metres_of_nominal_unit / scene.metres_per_unit;
    const auto stored = [&](std::uint32_t vertex) {
        const float distance = free_distance[vertex];
        return distance > threshold ? distance : std::min(distance, 0.0F);
    };
    const auto take = [&](std::uint32_t vertex) {
        if (new_index[vertex] == freespace::none) {
            new_index[vertex] = static_cast<std::uint32_t>(contents.vertices.size());
            const Vec3f& p = mesh.vertices[vertex];
            contents.vertices.push_back({p.x(), p.y(), p.z(), stored(vertex)});
        }
        return new_index[vertex];
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        if (std::max({stored(a), stored(b), stored(c)}) <= 0.0F) continue;
        contents.triangles.push_back({take(a), take(b), take(c)});
    }
    if (contents.triangles.empty())
        return fail(scene.source + ": no free space is left within its bounds at this d0");

    for (const scene::SpawnPoint& spawn : scene.spawn_points)
        contents.spawn_points.push_back({spawn.eye.cast<float>(), static_cast<float>(spawn.yaw)});
    if (contents.spawn_points.empty()) contents.spawn_points.push_back(widest_place(contents, scene.bounds));
    std::size_t covered_spawn_points = 0;
    for (std::size_t i = 0; i < contents.spawn_points.size(); ++i) {
        if (!stage.advance(i, contents.spawn_points.size())) return stage.interrupted();
        covered_spawn_points += covered(contents.spawn_points[i].eye.cast<double>(), contents);
    }
    stage.count("vertices", static_cast<double>(contents.vertices.size()));
    stage.count("triangles", static_cast<double>(contents.triangles.size()));
    stage.count("covered spawn points", static_cast<double>(covered_spawn_points));
    return contents;
}

}  // namespace camdir::bake
