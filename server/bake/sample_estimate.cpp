#include "bake/sample_estimate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

#include "bake/bisection.hpp"
#include "base/parallel.hpp"

namespace camdir::bake {
namespace {

// Two estimates with different paths differ by a few percent.
constexpr std::uint64_t path_count = 4096;
constexpr int max_depth = 64;  // more would be more samples than can be counted

// What part of a midpoint on each edge of a piece is the piece's own: all triangles with that edge make the
// same point.
using EdgeShares = std::array<double, 3>;

// The edges of all triangles.
class SharedEdges {
  public:
    explicit SharedEdges(const scene::Scene& scene) {
        edges_.reserve(3 * scene.triangles.size());
        for (const auto& [a, b, c] : scene.triangles)
            for (const Edge& edge : {edge_of(a, b), edge_of(b, c), edge_of(c, a)})
                edges_.push_back(edge);
        parallel_sort(edges_.begin(), edges_.end(), std::less<>());
    }

    [[nodiscard]] EdgeShares shares(const std::array<std::uint32_t, 3>& triangle) const {
        const auto& [a, b, c] = triangle;
        return {share(edge_of(a, b)), share(edge_of(b, c)), share(edge_of(c, a))};
    }

  private:
    using Edge = std::pair<std::uint32_t, std::uint32_t>;

    static Edge edge_of(std::uint32_t a, std::uint32_t b) { return std::minmax(a, b); }

    [[nodiscard]] double share(const Edge& edge) const {
        const auto [first, last] = std::equal_range(edges_.begin(), edges_.end(), edge);
        return 1.0 / static_cast<double>(last - first);
    }

    std::vector<Edge> edges_;
};

// A piece on a path.
struct Node {
    Piece piece;
    EdgeShares edge_shares;
};

Node child(const Bisection& bisection, const Node& parent, bool second) {
    constexpr double inside = 0.5;  // on the edge between the halves
    const int from = longest_edge(parent.piece.corners);
    const double of_cut = parent.edge_shares[from];
    const double of_next = parent.edge_shares[(from + 1) % 3];
    const double of_last = parent.edge_shares[(from + 2) % 3];
    return {bisection.halves(parent.piece)[second ? 1 : 0],
            second ? EdgeShares{of_cut, of_next, inside} : EdgeShares{of_cut, inside, of_last}};
}

// body(piece, samples) for the pieces that are cut on the path down from one, each with the number of
// midpoints of its depth that it stands for. The bits of `turns` choose the halves.
template <class Body>
void for_cuts_on_path(const Bisection& bisection, Node node, std::uint64_t turns, const Body& body) {
    double pieces = 1.0;
    for (int depth = 0; depth < max_depth && !bisection.is_fine(node.piece); ++depth) {
        body(node.piece, pieces * node.edge_shares[longest_edge(node.piece.corners)]);
        node = child(bisection, node, turns >> 63U != 0);
        if (bisection.is_buried(node.piece.corners)) return;
        turns <<= 1U;
        pieces *= 2.0;
    }
}

// Large triangles get samples by their area, slivers by their length.
double weight(const Triangle3d& t, double d0) {
    return area(t) + d0 * std::sqrt(longest_edge_length2(t));
}

std::vector<double> cumulative_weights(const scene::Scene& scene, double d0) {
    std::vector<double> up_to;
    up_to.reserve(scene.triangles.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        up_to.push_back(sum += weight(scene::corners(scene, i), d0));
    return up_to;
}

}  // namespace

SampleEstimate::SampleEstimate(const scene::Scene& scene, const Solids& solids,
                               const SamplingDistance& distance, double slack)
    : corners_(static_cast<double>(scene.vertices.size())) {
    if (scene.triangles.empty()) return;
    const Bisection bisection(solids, distance, slack);
    const SharedEdges shared_edges(scene);
    const std::vector<double> weight_up_to = cumulative_weights(scene, distance.finest());
    const double step = weight_up_to.back() / static_cast<double>(path_count);
    std::vector<std::vector<Midpoint>> paths(path_count);
    parallel_for(std::uint64_t{0}, path_count, [&](std::uint64_t i) {
        const double position = (static_cast<double>(i) + 0.5) * step;
        const auto found = std::upper_bound(weight_up_to.begin(), weight_up_to.end() - 1, position);
        const auto index = static_cast<std::size_t>(found - weight_up_to.begin());
        const Triangle3d t = scene::corners(scene, index);
        if (bisection.is_buried(t)) return;
        const double triangles = step / weight(t, distance.finest());
        const Node root{bisection.piece(t), shared_edges.shares(scene.triangles[index])};
        // Multiples of the golden ratio part evenly: so do the paths through one triangle.
        const std::uint64_t turns = i * 0x9e3779b97f4a7c15U;
        for_cuts_on_path(bisection, root, turns, [&](const Piece& piece, double samples) {
            paths[i].push_back({bisection.fine_above_d0(piece), triangles * samples});
        });
    });
    for (const auto& path : paths)
        midpoints_.insert(midpoints_.end(), path.begin(), path.end());
}

double SampleEstimate::samples(double d0) const {
    if (known_samples_ > 0.0) return known_samples_ * std::min(1.0, std::pow(known_d0_ / d0, 2.0));
    double samples = corners_;
    for (const Midpoint& midpoint : midpoints_)
        if (midpoint.up_to_d0 >= d0) samples += midpoint.samples;
    return samples;
}

}  // namespace camdir::bake
