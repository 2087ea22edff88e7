#include "bake/reduce.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bake/reduction/decimation_state.hpp"
#include "bake/reduction/edge_collapser.hpp"
#include "bake/reduction/regions.hpp"

namespace camdir::bake {
namespace {

// The allowed loss grows from round to round, so that the cheap collapses of the whole map come first.
constexpr double first_share = 1.0 / 4.0;
constexpr double share_factor = 2.0;
constexpr int full_rounds = 3;  // with the whole loss allowed, each with its region borders elsewhere
constexpr std::array<double, 3> cut_fractions{0.5, 0.36, 0.61};

// A triangle of the complex with another free distance at one corner.
Slab slab_with(const DecimationState& state, const Complex::Corners& corners, std::size_t corner,
               double distance) {
    Triangle3d positions;
    std::array<double, 3> radii{};
    for (std::size_t i = 0; i < 3; ++i) {
        positions[i] = state.position(corners[i]);
        radii[i] = i == corner ? distance : state.vertices[corners[i]].free_distance;
    }
    return {positions, radii};
}

// The largest free distance of the vertex, up to that in the unreduced mesh, that keeps its slabs free: each
// violation is an upper bound, and lowering a free distance keeps a slab free. The present one when the
// search takes too many steps.
float max_free_distance(const DecimationState& state, std::uint32_t vertex) {
    constexpr int max_steps = 12;
    constexpr double rounding = 1e-4;  // of the loss
    const float kept = state.vertices[vertex].free_distance;
    float distance = state.unreduced_distance[vertex];
    for (const std::uint32_t triangle : state.complex.star(vertex)) {
        const Complex::Corners& corners = state.complex.corners(triangle);
        const auto corner =
            static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
        for (int step = 0;; ++step) {
            if (!(distance > kept) || step == max_steps) return kept;
            const SignedGap worst =
                signed_gap(slab_with(state, corners, corner, distance), state.obstacles, 0.0);
            if (worst.value >= 0.0) break;
            const double lowered = distance + worst.value / std::max(worst.weights[corner], 1e-6);
            distance = static_cast<float>(lowered - rounding * state.reduction.max_loss);
        }
    }
    return distance;
}

std::vector<std::uint32_t> used_vertices(const Complex& complex, std::size_t vertex_count) {
    std::vector<std::uint32_t> used;
    for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
        if (!complex.star(vertex).empty()) used.push_back(vertex);
    }
    return used;
}

// The remaining vertices, cut into regions.
struct Partition {
    Partition(const DecimationState& state, std::span<const Vec3f> positions, double fraction)
        : regions(
              make_regions(positions, used_vertices(state.complex, positions.size()), region_size, fraction)),
          indices(positions.size()) {
        for (const auto& region : regions)
            vertex_count += static_cast<double>(region.size());
        for (std::uint32_t region = 0; region < regions.size(); ++region) {
            for (std::uint32_t index = 0; index < regions[region].size(); ++index)
                indices[regions[region][index]] = {region, index};
        }
    }

    std::vector<std::vector<std::uint32_t>> regions;
    std::vector<RegionIndex> indices;
    double vertex_count = 0.0;
};

// How many triangles a region should remove so that all together leave the requested number.
std::uint64_t target_of(const DecimationState& state, std::uint64_t count, double share_of_vertices) {
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    if (state.reduction.triangles == 0) return all;
    const std::uint64_t surplus = count - std::min<std::uint64_t>(count, state.reduction.triangles);
    return static_cast<std::uint64_t>(std::ceil(share_of_vertices * static_cast<double>(surplus)));
}

// Collapses what loses at most `share` of the allowed loss, in all regions at once.
bool run_round(DecimationState& state, std::span<const Vec3f> positions, double share, double fraction,
               Stage& stage) {
    const Partition partition(state, positions, fraction);
    const std::uint64_t count = state.complex.triangle_count();
    std::vector<std::uint64_t> targets;
    for (const auto& region : partition.regions)
        targets.push_back(
            target_of(state, count, static_cast<double>(region.size()) / partition.vertex_count));
    return stage.for_each(partition.regions.size(), [&](std::uint64_t i) {
        const auto number = static_cast<std::uint32_t>(i);
        EdgeCollapser(state, partition.indices, partition.regions[i], number,
                      share * state.reduction.max_loss)
            .run(targets[i], stage);
    });
}

// Raises the free distances of the vertices inside the regions as far as their slabs stay free. Once each: a
// neighbour that gains later leaves a vertex no more room.
bool raise_round(DecimationState& state, std::span<const Vec3f> positions, double fraction,
                 std::vector<char>& raised, Stage& stage) {
    const Partition partition(state, positions, fraction);
    return stage.for_each(partition.regions.size(), [&](std::uint64_t i) {
        std::vector<std::uint32_t> neighbours;
        for (const std::uint32_t vertex : partition.regions[i]) {
            if (raised[vertex] != 0 || stage.stopping()) continue;
            state.complex.neighbours(vertex, neighbours);
            const bool inside = std::all_of(neighbours.begin(), neighbours.end(), [&](std::uint32_t n) {
                return partition.indices[n].region == i;
            });
            if (!inside) continue;
            state.vertices[vertex].free_distance = max_free_distance(state, vertex);
            raised[vertex] = 1;
        }
    });
}

void compact(MedialMesh& mesh, std::vector<float>& free_distance,
             std::span<const freespace::Triangle> triangles) {
    std::vector<std::uint32_t> new_index(mesh.vertices.size(), freespace::none);
    MedialMesh compacted;
    std::vector<float> compacted_distance;
    const auto index_of = [&](std::uint32_t vertex) {
        if (new_index[vertex] == freespace::none) {
            new_index[vertex] = static_cast<std::uint32_t>(compacted.vertices.size());
            compacted.vertices.push_back(mesh.vertices[vertex]);
            compacted_distance.push_back(free_distance[vertex]);
        }
        return new_index[vertex];
    };
    for (const freespace::Triangle& t : triangles)
        compacted.triangles.push_back({index_of(t.a), index_of(t.b), index_of(t.c)});
    mesh = std::move(compacted);
    free_distance = std::move(compacted_distance);
}

}  // namespace

double mean_free_distance(const MedialMesh& mesh, const std::vector<float>& free_distance) {
    double sum = 0.0;
    double areas = 0.0;
    for (const freespace::Triangle& t : mesh.triangles) {
        const double of_one = area(mesh.corners(t));
        for (const std::uint32_t vertex : {t.a, t.b, t.c})
            sum += of_one / 3.0 * std::max(0.0F, free_distance[vertex]);
        areas += of_one;
    }
    return areas > 0.0 ? sum / areas : 0.0;
}

Result<void> reduce(MedialMesh& mesh, std::vector<float>& free_distance, const scene::Scene& scene,
                    const Obstacles& obstacles, const Reduction& reduction, Stage& stage) {
    DecimationState state(mesh, free_distance, scene, obstacles, reduction);
    int round = 0;
    int at_full_share = 0;
    double spent = 0.0;
    for (double share = first_share; at_full_share < full_rounds;
         share = std::min(1.0, share * share_factor)) {
        if (share > spent) state.spend_slack(share);
        spent = share;
        if (share >= 1.0) ++at_full_share;
        const double fraction = cut_fractions[static_cast<std::size_t>(round++) % cut_fractions.size()];
        if (!run_round(state, mesh.vertices, share, fraction, stage)) return stage.interrupted();
        if (reduction.triangles > 0 && state.complex.triangle_count() <= reduction.triangles) break;
    }
    std::vector<char> raised(mesh.vertices.size(), 0);
    for (const double fraction : {cut_fractions[1], cut_fractions[2]})
        if (!raise_round(state, mesh.vertices, fraction, raised, stage)) return stage.interrupted();
    for (std::size_t i = 0; i < free_distance.size(); ++i)
        free_distance[i] = state.vertices[i].free_distance;
    compact(mesh, free_distance, state.complex.triangles());
    stage.count("vertices", static_cast<double>(mesh.vertices.size()));
    stage.count("triangles", static_cast<double>(mesh.triangles.size()));
    return {};
}

}  // namespace camdir::bake
