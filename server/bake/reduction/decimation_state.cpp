#include "bake/reduction/decimation_state.hpp"

#include <algorithm>

#include "base/parallel.hpp"
#include "freespace/slab.hpp"

namespace camdir::bake {
namespace {

constexpr double slack_of_loss = 0.3;
constexpr double max_slack = 0.25;   // of the free distance above the offset: a vertex with a ball keeps one
constexpr double spawn_share = 0.5;  // of that above the offset, which a spawn point keeps

}  // namespace

CoveringSlab find_covering_slab(std::span<const freespace::Vertex> vertices,
                                std::span<const freespace::Triangle> triangles, const Vec3d& point) {
    const freespace::MeshView mesh{vertices, triangles};
    freespace::SlabPoint best;
    freespace::improve_range(mesh, point.cast<float>(), 0, static_cast<std::uint32_t>(triangles.size()),
                             best);
    if (best.triangle == freespace::none) return {};
    const freespace::Ball ball = freespace::ball_at(mesh, best);
    return {best.triangle, ball.radius - (point - ball.centre).norm()};
}

DecimationState::DecimationState(const MedialMesh& mesh, const std::vector<float>& free_distance,
                                 const scene::Scene& scene, const Obstacles& around, const Reduction& limits)
    : unreduced_distance(free_distance),
      obstacles(around),
      reduction(limits),
      complex(mesh),
      samples(mesh.triangles.size()),
      certified(mesh.vertices.size()),
      last_violated(mesh.vertices.size(), freespace::none) {
    vertices.reserve(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        const Vec3f& p = mesh.vertices[i];
        vertices.push_back({p.x(), p.y(), p.z(), free_distance[i]});
    }
    for (std::uint32_t vertex = 0; vertex < vertices.size(); ++vertex) {
        const auto star = complex.star(vertex);
        const double distance = vertices[vertex].free_distance;
        if (distance > reduction.offset_radius && !star.empty())
            samples[star.front()].push_back({position(vertex), distance});
    }
    const std::vector<scene::SpawnPoint>& spawns = scene.spawn_points;
    std::vector<CoveringSlab> covering(spawns.size());
    parallel_for(std::size_t{0}, covering.size(), [&](std::size_t i) {
        covering[i] = find_covering_slab(vertices, mesh.triangles, spawns[i].eye);
    });
    for (std::size_t i = 0; i < covering.size(); ++i) {
        const auto& [position, distance] = covering[i];
        const double above = distance - reduction.offset_radius;
        if (above > 0.0)
            samples[position].push_back(
                {spawns[i].eye, distance, reduction.offset_radius + spawn_share * above});
    }
}

std::vector<bool> DecimationState::constrained_vertices() const {
    std::vector<bool> constrained(vertices.size());
    for (std::uint32_t triangle = 0; triangle < samples.size(); ++triangle)
        for (const ConstraintSample& sample : samples[triangle])
            if (sample.min_distance > 0.0)
                for (const std::uint32_t corner : complex.corners(triangle))
                    constrained[corner] = true;
    return constrained;
}

void DecimationState::spend_slack(double share) {
    const std::vector<bool> constrained = constrained_vertices();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        certified[i].clear();
        const double unreduced = unreduced_distance[i];
        const double above = unreduced - reduction.offset_radius;
        if (!(above > 0.0) || constrained[i]) continue;
        const double slack = std::min(slack_of_loss * reduction.max_loss, max_slack * above);
        vertices[i].free_distance =
            std::min(vertices[i].free_distance, static_cast<float>(unreduced - share * slack));
    }
}

}  // namespace camdir::bake
