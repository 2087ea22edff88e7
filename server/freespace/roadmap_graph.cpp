#include "freespace/roadmap_graph.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <utility>

#include "freespace/roadmap.hpp"

namespace camdir::freespace {
namespace {

constexpr float unreached = std::numeric_limits<float>::infinity();

}  // namespace

RoadmapGraph::RoadmapGraph(std::span<const Vertex> vertices, std::span<const Triangle> triangles) {
    add_arcs(vertices, triangles);
    number_components();
    measure_landmarks();
}

void RoadmapGraph::add_arcs(std::span<const Vertex> vertices, std::span<const Triangle> triangles) {
    std::vector<RoadmapEdge> ends;  // from, to
    for (const auto& [a, b, c] : triangles)
        for (const auto& [from, to] : {RoadmapEdge{a, b}, RoadmapEdge{b, c}, RoadmapEdge{c, a}})
            if (on_roadmap(vertices[from]) && on_roadmap(vertices[to])) {
                ends.push_back({from, to});
                ends.push_back({to, from});
            }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    offsets_.assign(vertices.size() + 1, 0);
    arcs_.reserve(ends.size());
    for (const auto& [from, to] : ends) {
        ++offsets_[from + 1];
        arcs_.push_back({to, (vertices[to].position() - vertices[from].position()).norm()});
    }
    for (std::size_t v = 0; v < vertices.size(); ++v)
        offsets_[v + 1] += offsets_[v];
    components_.assign(vertices.size(), none);
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
        if (on_roadmap(vertices[v])) components_[v] = v;
}

// Of each vertex on the roadmap, before: itself.
void RoadmapGraph::number_components() {
    std::vector<std::uint32_t> pending;
    for (std::uint32_t seed = 0; seed < components_.size(); ++seed) {
        if (components_[seed] != seed) continue;
        pending.push_back(seed);
        while (!pending.empty()) {
            const std::uint32_t vertex = pending.back();
            pending.pop_back();
            for (const Arc& arc : arcs(vertex)) {
                if (components_[arc.to] == seed) continue;
                components_[arc.to] = seed;
                pending.push_back(arc.to);
            }
        }
    }
}

// The landmarks lie in the largest component, each as far as possible from those before.
void RoadmapGraph::measure_landmarks() {
    landmarks_.assign(components_.size(), Landmarks{});
    std::vector<std::uint32_t> sizes(components_.size(), 0);
    for (const std::uint32_t component : components_)
        if (component != none) ++sizes[component];
    const auto largest = std::max_element(sizes.begin(), sizes.end());
    if (largest == sizes.end() || *largest == 0) return;
    const auto farthest = [](const std::vector<float>& distances) {
        std::size_t vertex = 0;
        for (std::size_t v = 0; v < distances.size(); ++v)
            if (distances[v] != unreached && !(distances[v] <= distances[vertex])) vertex = v;
        return static_cast<std::uint32_t>(vertex);
    };
    std::vector<float> nearest = distances_from(static_cast<std::uint32_t>(largest - sizes.begin()));
    for (float& distance : nearest)
        if (distance == unreached) distance = -1.0F;
    for (int landmark = 0; landmark < landmark_count; ++landmark) {
        const std::vector<float> distances = distances_from(farthest(nearest));
        for (std::size_t v = 0; v < distances.size(); ++v) {
            if (distances[v] == unreached) continue;
            landmarks_[v].part[landmark / lane_count][landmark % lane_count] = distances[v];
            nearest[v] = landmark == 0 ? distances[v] : std::min(nearest[v], distances[v]);
        }
    }
}

std::vector<float> RoadmapGraph::distances_from(std::uint32_t start) const {
    std::vector<float> distances(components_.size(), unreached);
    using Open = std::pair<float, std::uint32_t>;
    std::vector<Open> open{{0.0F, start}};
    distances[start] = 0.0F;
    while (!open.empty()) {
        std::pop_heap(open.begin(), open.end(), std::greater<>());
        const auto [distance, vertex] = open.back();
        open.pop_back();
        if (distance > distances[vertex]) continue;
        for (const Arc& arc : arcs(vertex)) {
            const float longer = distance + arc.length;
            if (longer >= distances[arc.to]) continue;
            distances[arc.to] = longer;
            open.emplace_back(longer, arc.to);
            std::push_heap(open.begin(), open.end(), std::greater<>());
        }
    }
    return distances;
}

std::size_t RoadmapGraph::memory() const {
    return offsets_.capacity() * sizeof(std::uint32_t) + arcs_.capacity() * sizeof(Arc) +
           components_.capacity() * sizeof(std::uint32_t) + landmarks_.capacity() * sizeof(Landmarks);
}

}  // namespace camdir::freespace
