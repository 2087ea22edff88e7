#include "bake/reduction/decimation_state.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "freespace/slab.hpp"

namespace camdir::bake {
namespace {

constexpr double slack_of_loss = 0.3;
constexpr double most_slack = 0.25;  // of the free distance above the margin: what has a ball keeps one
constexpr double spawn_share = 0.5;  // of that above the margin, which a spawn point keeps

}  // namespace

Home find_home(std::span<const freespace::Vertex> vertices, std::span<const freespace::Triangle> triangles,
               const Vec3d& point) {
    const freespace::MeshView mesh{vertices, triangles, {}, {}, {}, {}};
    freespace::SlabPoint best;
    freespace::improve_range(mesh, point.cast<float>(), 0, static_cast<std::uint32_t>(triangles.size()),
                             best);
    if (best.triangle == freespace::none) return {};
    const freespace::Ball ball = freespace::ball_at(mesh, best);
    return {best.triangle, ball.radius - (point - ball.centre).norm()};
}

Shrinking::Shrinking(const MedialMesh& mesh, const std::vector<float>& free_distance,
                     const scene::Scene& scene, const Obstacles& around, const Reduction& wanted)
    : whole_distance(free_distance),
      obstacles(around),
      reduction(wanted),
      complex(mesh),
      witnesses(mesh.triangles.size()),
      certified(mesh.vertices.size()),
      suspect(mesh.vertices.size(), freespace::none) {
    vertices.reserve(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3f& p = mesh.vertices[i];
        vertices.push_back({p.x(), p.y(), p.z(), free_distance[i]});
    }
    for (std::uint32_t vertex = 0; vertex < vertices.size(); ++vertex) {
        const auto star = complex.star(vertex);
        const double distance = vertices[vertex].free_distance;
        if (distance > reduction.margin && !star.empty())
            witnesses[star.front()].push_back({position(vertex), distance});
    }
    const std::vector<scene::SpawnPoint>& spawns = scene.spawn_points;
    std::vector<Home> homes(spawns.size());
    parallel_for(std::size_t{0}, homes.size(),
                 [&](std::size_t i) { homes[i] = find_home(vertices, mesh.triangles, spawns[i].eye); });
    for (std::size_t i = 0; i < homes.size(); ++i) {
        const auto& [position, distance] = homes[i];
        const double above = distance - reduction.margin;
        if (above > 0.0)
            witnesses[position].push_back({spawns[i].eye, distance, reduction.margin + spawn_share * above});
    }
}

std::vector<bool> Shrinking::bound_vertices() const {
    std::vector<bool> bound(vertices.size());
    for (std::uint32_t triangle = 0; triangle < witnesses.size(); ++triangle)
        for (const Witness& witness : witnesses[triangle])
            if (witness.least > 0.0)
                for (const std::uint32_t corner : complex.corners(triangle))
                    bound[corner] = true;
    return bound;
}

void Shrinking::give_slack(double share) {
    const std::vector<bool> bound = bound_vertices();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        certified[i].clear();
        const double whole = whole_distance[i];
        const double above = whole - reduction.margin;
        if (!(above > 0.0) || bound[i]) continue;
        const double slack = std::min(slack_of_loss * reduction.loss, most_slack * above);
        vertices[i].free_distance =
            std::min(vertices[i].free_distance, static_cast<float>(whole - share * slack));
    }
}

}  // namespace camdir::bake
