#include "render/roadmap.hpp"

#include <algorithm>

namespace camdir::render {

std::vector<Edge> roadmap_edges(const freespace::Freespace& freespace) {
    const auto vertices = freespace.vertices();
    std::vector<Edge> edges;
    for (const auto& [a, b, c] : freespace.triangles()) {
        for (const Edge& edge : {Edge{a, b}, Edge{b, c}, Edge{c, a}}) {
            if (vertices[edge[0]].free_distance <= 0.0F || vertices[edge[1]].free_distance <= 0.0F) continue;
            edges.push_back({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
        }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

}  // namespace camdir::render
