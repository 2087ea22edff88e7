#include "bench/paper/link.hpp"

#include <algorithm>

namespace camdir::paper {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

// The link as a graph.
class Graph {
  public:
    explicit Graph(const std::vector<Edge>& link) {
        for (const auto& [a, b] : link) {
            arcs_.emplace_back(a, b);
            arcs_.emplace_back(b, a);
        }
        std::sort(arcs_.begin(), arcs_.end());
    }

    [[nodiscard]] std::uint32_t smallest() const { return arcs_.front().first; }
    [[nodiscard]] bool repeats_an_edge() const {
        return std::adjacent_find(arcs_.begin(), arcs_.end()) != arcs_.end();
    }
    [[nodiscard]] std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const {
        std::vector<std::uint32_t> result;
        for (auto arc = first_arc(vertex); arc != arcs_.end() && arc->first == vertex; ++arc)
            result.push_back(arc->second);
        return result;
    }
    // Vertices where other than two edges meet.
    [[nodiscard]] std::vector<std::uint32_t> hubs() const {
        std::vector<std::uint32_t> result;
        for (std::size_t i = 0; i < arcs_.size();) {
            std::size_t end = i;
            while (end < arcs_.size() && arcs_[end].first == arcs_[i].first)
                ++end;
            if (end - i != 2) result.push_back(arcs_[i].first);
            i = end;
        }
        return result;
    }
    // From `start` over `next` to the first hub or back to `start`; that vertex is the last.
    [[nodiscard]] Fan walk(std::uint32_t start, std::uint32_t next) const {
        Fan fan{start, next};
        while (fan.back() != start) {
            const auto around = neighbours(fan.back());
            if (around.size() != 2) break;
            fan.push_back(around[0] == fan[fan.size() - 2] ? around[1] : around[0]);
        }
        return fan;
    }

  private:
    [[nodiscard]] std::vector<Edge>::const_iterator first_arc(std::uint32_t vertex) const {
        return std::lower_bound(arcs_.begin(), arcs_.end(), Edge{vertex, 0});
    }

    std::vector<Edge> arcs_;
};

}  // namespace

std::optional<Surroundings> surroundings(const std::vector<Edge>& link) {
    if (link.size() < 3) return std::nullopt;
    const Graph graph(link);
    if (graph.repeats_an_edge()) return std::nullopt;
    const std::vector<std::uint32_t> hubs = graph.hubs();
    Surroundings result;
    if (hubs.empty()) {
        Fan cycle = graph.walk(graph.smallest(), graph.neighbours(graph.smallest()).front());
        if (cycle.size() != link.size() + 1) return std::nullopt;  // the link has another cycle
        cycle.pop_back();
        result.fans.push_back(std::move(cycle));
        result.closed = true;
        return result;
    }
    if (hubs.size() != 2) return std::nullopt;
    const auto starts = graph.neighbours(hubs[0]);
    if (starts.size() < 3) return std::nullopt;
    std::size_t edges = 0;
    for (const std::uint32_t start : starts) {
        result.fans.push_back(graph.walk(hubs[0], start));
        // A fan without a vertex between would be a triangle at both seam edges.
        if (result.fans.back().back() != hubs[1] || result.fans.back().size() < 3) return std::nullopt;
        edges += result.fans.back().size() - 1;
    }
    return edges == link.size() ? std::optional(result) : std::nullopt;
}

}  // namespace camdir::paper
