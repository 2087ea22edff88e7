#include "bake/inside.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/disjoint_sets.hpp"

namespace camdir::bake {
namespace {

DisjointSets connect(const MedialMesh& mesh) {
    DisjointSets parts(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles) {
        parts.unite(a, b);
        parts.unite(b, c);
    }
    return parts;
}

// Those that are the corner of a triangle.
std::vector<char> used_vertices(const MedialMesh& mesh) {
    std::vector<char> used(mesh.vertices.size());
    for (const auto& [a, b, c] : mesh.triangles)
        used[a] = used[b] = used[c] = 1;
    return used;
}

// The parts of the spawn points, marked at their representatives.
Result<std::vector<char>> parts_with_spawn_points(const MedialMesh& mesh,
                                                  const std::vector<double>& clearance,
                                                  const scene::Scene& scene, DisjointSets& parts,
                                                  Stage& stage) {
    const std::vector<char> used = used_vertices(mesh);
    std::vector<char> selected(mesh.vertices.size());
    std::vector<char> connected(scene.spawn_points.size());
    for (std::uint32_t vertex = 0; vertex < used.size(); ++vertex) {
        if (vertex % 16384 == 0 && !stage.advance(vertex, used.size())) return stage.interrupted();
        if (!used[vertex]) continue;
        for (std::size_t spawn = 0; spawn < connected.size(); ++spawn) {
            const Vec3d to_eye = scene.spawn_points[spawn].eye - mesh.position(vertex);
            if (to_eye.norm() >= clearance[vertex]) continue;
            selected[parts.find(vertex)] = 1;
            connected[spawn] = 1;
        }
    }
    const auto count = std::count(connected.begin(), connected.end(), 1);
    stage.count("spawn points", static_cast<double>(connected.size()));
    stage.count("connected spawn points", static_cast<double>(count));
    if (count == 0)
        return fail(scene.source + ": none of the " + std::to_string(connected.size()) +
                    " spawn points and seeds is in free space that is wide enough for this d0; expected a "
                    "--seed in the open, or a smaller --d0");
    return selected;
}

// By the area whose balls lie in the map's bounds: the space around an open map, whose balls reach out of
// them, does not count. Ties by the whole area.
std::vector<char> largest_part(const MedialMesh& mesh, const std::vector<double>& clearance,
                               const Box3d& bounds, DisjointSets& parts) {
    const auto is_within = [&](std::uint32_t vertex) {
        return clearance[vertex] <= depth_in(bounds, mesh.position(vertex));
    };
    std::map<std::uint32_t, std::pair<double, double>> areas;
    for (const freespace::Triangle& t : mesh.triangles) {
        const double of_one = area(mesh.corners(t));
        const bool counts = is_within(t.a) && is_within(t.b) && is_within(t.c);
        std::set<std::uint32_t> found;  // several where the triangle joins nothing
        for (const std::uint32_t vertex : {t.a, t.b, t.c})
            if (clearance[vertex] > 0.0) found.insert(parts.find(vertex));
        for (const std::uint32_t part : found) {
            auto& [within, whole] = areas[part];
            within += counts ? of_one : 0.0;
            whole += of_one;
        }
    }
    std::vector<char> selected(mesh.vertices.size());
    const auto largest = std::max_element(areas.begin(), areas.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
    if (largest != areas.end()) selected[largest->first] = 1;
    return selected;
}

Result<std::vector<char>> select_parts(const MedialMesh& mesh, const std::vector<double>& clearance,
                                       const scene::Scene& scene, DisjointSets& parts, Stage& stage) {
    if (scene.spawn_points.empty()) return largest_part(mesh, clearance, scene.bounds, parts);
    return parts_with_spawn_points(mesh, clearance, scene, parts, stage);
}

// Keeps the triangles of the selected parts.
void keep_parts(MedialMesh& mesh, const std::vector<char>& selected, DisjointSets& parts, Stage& stage) {
    std::vector<char> keep(mesh.triangles.size());
    for (std::size_t i = 0; i < keep.size(); ++i) {
        const freespace::Triangle& t = mesh.triangles[i];
        for (const std::uint32_t vertex : {t.a, t.b, t.c})
            keep[i] = keep[i] || selected[parts.find(vertex)];
    }
    keep_triangles(mesh, keep);
    stage.count("inside triangles", static_cast<double>(mesh.triangles.size()));
}

}  // namespace

Result<void> keep_inside(MedialMesh& mesh, const std::vector<double>& clearance, const scene::Scene& scene,
                         const Solids& solids, Stage& stage) {
    DisjointSets parts = connect(mesh);
    const auto selected = select_parts(mesh, clearance, scene, parts, stage);
    if (!selected) return tl::unexpected(selected.error());

    keep_parts(mesh, *selected, parts, stage);
    std::vector<char> keep(mesh.triangles.size());
    const bool done = stage.for_each(keep.size(), [&](std::uint64_t i) {
        const auto& [a, b, c] = mesh.triangles[i];
        keep[i] = !solids.contains(mesh.position(a)) && !solids.contains(mesh.position(b)) &&
                  !solids.contains(mesh.position(c));
    });
    if (!done) return stage.interrupted();
    keep_triangles(mesh, keep);
    stage.count("triangles", static_cast<double>(mesh.triangles.size()));
    return {};
}

Result<void> keep_inside_cloud(MedialMesh& mesh, const std::vector<double>& clearance,
                               const std::vector<float>& free_distance, double offset_radius, double passage,
                               const scene::Scene& scene, Stage& stage) {
    const auto is_wide = [&](std::uint32_t vertex) {
        return free_distance[vertex] > offset_radius + passage;
    };
    DisjointSets parts(mesh.vertices.size());
    std::vector<char> keep(mesh.triangles.size());
    for (std::size_t i = 0; i < keep.size(); ++i) {
        const auto& [a, b, c] = mesh.triangles[i];
        keep[i] = is_wide(a) || is_wide(b) || is_wide(c);
        if (is_wide(a) && is_wide(b)) parts.unite(a, b);
        if (is_wide(b) && is_wide(c)) parts.unite(b, c);
        if (is_wide(c) && is_wide(a)) parts.unite(c, a);
    }
    keep_triangles(mesh, keep);
    // Nothing is known to be connected with the other vertices.
    std::vector<double> free(mesh.vertices.size());
    for (std::uint32_t vertex = 0; vertex < free.size(); ++vertex)
        free[vertex] = is_wide(vertex) ? clearance[vertex] - offset_radius : 0.0;

    const auto selected = select_parts(mesh, free, scene, parts, stage);
    if (!selected) return tl::unexpected(selected.error());
    keep_parts(mesh, *selected, parts, stage);
    stage.count("triangles", static_cast<double>(mesh.triangles.size()));
    return {};
}

}  // namespace camdir::bake
