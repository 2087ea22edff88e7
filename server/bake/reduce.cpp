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
constexpr int last_rounds = 3;  // with the whole loss allowed, each with its borders elsewhere
constexpr std::array<double, 3> cuts{0.5, 0.36, 0.61};

// A triangle of the complex with another free distance at one corner.
Slab slab_with(const Shrinking& shrinking, const Complex::Corners& corners, std::size_t place,
               double distance) {
    Triangle3d positions;
    std::array<double, 3> radii{};
    for (std::size_t i = 0; i < 3; ++i) {
        positions[i] = shrinking.position(corners[i]);
        radii[i] = i == place ? distance : shrinking.vertices[corners[i]].free_distance;
    }
    return {positions, radii};
}

// The largest free distance of the vertex, up to that in the unreduced mesh, which keeps its slabs free. Each
// violation bounds it from above, so that going from bound to bound gives nothing away; what is free stays so
// when it gets lower.
float highest(const Shrinking& shrinking, std::uint32_t vertex) {
    constexpr int max_steps = 12;
    constexpr double rounding = 1e-4;  // of the loss
    const float kept = shrinking.vertices[vertex].free_distance;
    float distance = shrinking.whole_distance[vertex];
    for (const std::uint32_t triangle : shrinking.complex.star(vertex)) {
        const Complex::Corners& corners = shrinking.complex.corners(triangle);
        const auto place =
            static_cast<std::size_t>(std::find(corners.begin(), corners.end(), vertex) - corners.begin());
        for (int step = 0;; ++step) {
            if (!(distance > kept) || step == max_steps) return kept;
            const Margin worst =
                margin(slab_with(shrinking, corners, place, distance), shrinking.obstacles, 0.0);
            if (worst.value >= 0.0) break;
            const double lowered = distance + worst.value / std::max(worst.weights[place], 1e-6);
            distance = static_cast<float>(lowered - rounding * shrinking.reduction.loss);
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

// The vertices that are left, cut into regions.
struct Division {
    Division(const Shrinking& shrinking, std::span<const Vec3f> positions, double cut)
        : regions(
              make_regions(positions, used_vertices(shrinking.complex, positions.size()), region_size, cut)),
          places(positions.size()) {
        for (const auto& region : regions)
            vertex_count += static_cast<double>(region.size());
        for (std::uint32_t region = 0; region < regions.size(); ++region) {
            for (std::uint32_t index = 0; index < regions[region].size(); ++index)
                places[regions[region][index]] = {region, index};
        }
    }

    std::vector<std::vector<std::uint32_t>> regions;
    std::vector<Place> places;
    double vertex_count = 0.0;
};

// How many triangles a region should remove so that all together leave the wanted number.
std::uint64_t wanted_of(const Shrinking& shrinking, std::uint64_t count, double share_of_vertices) {
    constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    if (shrinking.reduction.triangles == 0) return all;
    const std::uint64_t surplus = count - std::min<std::uint64_t>(count, shrinking.reduction.triangles);
    return static_cast<std::uint64_t>(std::ceil(share_of_vertices * static_cast<double>(surplus)));
}

// Collapses what loses at most `share` of the allowed loss, in all regions at once.
bool run_round(Shrinking& shrinking, std::span<const Vec3f> positions, double share, double cut,
               Stage& stage) {
    const Division division(shrinking, positions, cut);
    const std::uint64_t count = shrinking.complex.triangle_count();
    std::vector<std::uint64_t> wanted;
    for (const auto& region : division.regions)
        wanted.push_back(
            wanted_of(shrinking, count, static_cast<double>(region.size()) / division.vertex_count));
    return stage.for_each(division.regions.size(), [&](std::uint64_t i) {
        const auto number = static_cast<std::uint32_t>(i);
        Collapses(shrinking, division.places, division.regions[i], number, share * shrinking.reduction.loss)
            .run(wanted[i], stage);
    });
}

// Raises the free distances of the vertices inside the regions again, as far as their slabs stay free. Once
// each: what its neighbours gain later leaves a vertex nothing more.
bool raise_round(Shrinking& shrinking, std::span<const Vec3f> positions, double cut,
                 std::vector<char>& raised, Stage& stage) {
    const Division division(shrinking, positions, cut);
    return stage.for_each(division.regions.size(), [&](std::uint64_t i) {
        std::vector<std::uint32_t> neighbours;
        for (const std::uint32_t vertex : division.regions[i]) {
            if (raised[vertex] != 0 || stage.stopping()) continue;
            shrinking.complex.neighbours(vertex, neighbours);
            const bool inside = std::all_of(neighbours.begin(), neighbours.end(),
                                            [&](std::uint32_t n) { return division.places[n].region == i; });
            if (!inside) continue;
            shrinking.vertices[vertex].free_distance = highest(shrinking, vertex);
            raised[vertex] = 1;
        }
    });
}

void compact(MedialMesh& mesh, std::vector<float>& free_distance,
             std::span<const freespace::Triangle> triangles) {
    std::vector<std::uint32_t> place(mesh.vertices.size(), freespace::none);
    MedialMesh left;
    std::vector<float> left_distance;
    const auto moved = [&](std::uint32_t vertex) {
        if (place[vertex] == freespace::none) {
            place[vertex] = static_cast<std::uint32_t>(left.vertices.size());
            left.vertices.push_back(mesh.vertices[vertex]);
            left_distance.push_back(free_distance[vertex]);
        }
        return place[vertex];
    };
    for (const freespace::Triangle& t : triangles)
        left.triangles.push_back({moved(t.a), moved(t.b), moved(t.c)});
    mesh = std::move(left);
    free_distance = std::move(left_distance);
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
    Shrinking shrinking(mesh, free_distance, scene, obstacles, reduction);
    int round = 0;
    int at_full_share = 0;
    double given = 0.0;
    for (double share = first_share; at_full_share < last_rounds;
         share = std::min(1.0, share * share_factor)) {
        if (share > given) shrinking.give_slack(share);
        given = share;
        if (share >= 1.0) ++at_full_share;
        const double cut = cuts[static_cast<std::size_t>(round++) % cuts.size()];
        if (!run_round(shrinking, mesh.vertices, share, cut, stage)) return stage.interrupted();
        if (reduction.triangles > 0 && shrinking.complex.triangle_count() <= reduction.triangles) break;
    }
    std::vector<char> raised(mesh.vertices.size(), 0);
    for (const double cut : {cuts[1], cuts[2]})
        if (!raise_round(shrinking, mesh.vertices, cut, raised, stage)) return stage.interrupted();
    for (std::size_t i = 0; i < free_distance.size(); ++i)
        free_distance[i] = shrinking.vertices[i].free_distance;
    compact(mesh, free_distance, shrinking.complex.triangles());
    stage.count("vertices", static_cast<double>(mesh.vertices.size()));
    stage.count("triangles", static_cast<double>(mesh.triangles.size()));
    return {};
}

}  // namespace camdir::bake
