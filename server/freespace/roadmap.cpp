#include "freespace/roadmap.hpp"

#include <algorithm>

#include "freespace/distance.hpp"

namespace camdir::freespace {
namespace {

template <class Visit>
void for_each_neighbour(const Freespace& freespace, std::uint32_t vertex, const Visit& visit) {
    for (const std::uint32_t t : freespace.incident(vertex)) {
        const auto [a, b, c] = freespace.triangles()[t];
        for (const std::uint32_t corner : {a, b, c})
            if (corner != vertex && on_roadmap(freespace.vertices()[corner])) visit(corner);
    }
}

// The heap's order: the smallest estimate on top, ties by number.
constexpr auto later = [](const auto& a, const auto& b) {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.vertex > b.vertex;
};

}  // namespace

std::vector<RoadmapEdge> roadmap_edges(const Freespace& freespace) {
    const auto vertices = freespace.vertices();
    std::vector<RoadmapEdge> edges;
    for (const auto& [a, b, c] : freespace.triangles())
        for (const auto& [from, to] : {RoadmapEdge{a, b}, RoadmapEdge{b, c}, RoadmapEdge{c, a}})
            if (on_roadmap(vertices[from]) && on_roadmap(vertices[to]))
                edges.push_back({std::min(from, to), std::max(from, to)});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

std::vector<std::uint32_t> roadmap_components(const Freespace& freespace) {
    const auto vertices = freespace.vertices();
    std::vector<std::uint32_t> component(vertices.size(), none);
    std::vector<std::uint32_t> pending;
    for (std::uint32_t seed = 0; seed < vertices.size(); ++seed) {
        if (component[seed] != none || !on_roadmap(vertices[seed])) continue;
        component[seed] = seed;
        pending.push_back(seed);
        while (!pending.empty()) {
            const std::uint32_t vertex = pending.back();
            pending.pop_back();
            for_each_neighbour(freespace, vertex, [&](std::uint32_t neighbour) {
                if (component[neighbour] != none) return;
                component[neighbour] = seed;
                pending.push_back(neighbour);
            });
        }
    }
    return component;
}

RoadmapSearch::RoadmapSearch(const Freespace& freespace)
    : freespace_(freespace), component_(roadmap_components(freespace)), labels_(freespace.vertices().size()) {
    // Each vertex is expanded once, over two edges of each of its triangles.
    open_.reserve(6 * freespace.triangles().size() + 3);
    path_.vertices.reserve(freespace.vertices().size());
}

RoadmapSearch::EntryVertices RoadmapSearch::entry_vertices(const Vec3f& point) const {
    EntryVertices entry;
    const Distance slab = distance_everywhere(freespace_, point);
    if (!slab.covered()) return entry;
    const auto [a, b, c] = freespace_.triangles()[slab.triangle];
    for (const std::uint32_t corner : {a, b, c})
        if (on_roadmap(freespace_.vertices()[corner])) entry.vertices[entry.count++] = corner;
    return entry;
}

// The entry vertices of a point are corners of one slab and so in one component.
const RoadmapPath& RoadmapSearch::find(const Vec3f& from, const Vec3f& to) {
    path_.found = false;
    path_.length = 0.0F;
    path_.vertices.clear();
    const EntryVertices start = entry_vertices(from);
    const EntryVertices goal = entry_vertices(to);
    if (start.count == 0 || goal.count == 0) return path_;
    if (component_[start.vertices[0]] != component_[goal.vertices[0]]) return path_;

    begin_round();
    for (const std::uint32_t vertex : start.span())
        reach(vertex, none, (freespace_.vertices()[vertex].position() - from).norm(), to);
    while (!open_.empty()) {
        std::pop_heap(open_.begin(), open_.end(), later);
        const auto [estimate, vertex] = open_.back();
        open_.pop_back();
        if (labels_[vertex].closed) continue;
        labels_[vertex].closed = true;
        // The estimate of a goal's entry vertex is its cost plus the distance to the goal: the path's length.
        if (std::ranges::find(goal.span(), vertex) != goal.span().end()) {
            trace(vertex, estimate);
            break;
        }
        expand(vertex, to);
    }
    return path_;
}

void RoadmapSearch::begin_round() {
    open_.clear();
    if (++round_ != 0) return;
    std::fill(labels_.begin(), labels_.end(), Label{});
    round_ = 1;
}

void RoadmapSearch::reach(std::uint32_t vertex, std::uint32_t parent, float cost, const Vec3f& goal) {
    Label& label = labels_[vertex];
    if (label.round == round_ && (label.closed || label.cost <= cost)) return;
    label = {cost, parent, round_, false};
    open_.push_back({cost + (freespace_.vertices()[vertex].position() - goal).norm(), vertex});
    std::push_heap(open_.begin(), open_.end(), later);
}

void RoadmapSearch::expand(std::uint32_t vertex, const Vec3f& goal) {
    const Vec3f position = freespace_.vertices()[vertex].position();
    const float cost = labels_[vertex].cost;
    for_each_neighbour(freespace_, vertex, [&](std::uint32_t neighbour) {
        reach(neighbour, vertex, cost + (freespace_.vertices()[neighbour].position() - position).norm(),
              goal);
    });
}

void RoadmapSearch::trace(std::uint32_t last, float length) {
    path_.found = true;
    path_.length = length;
    for (std::uint32_t vertex = last; vertex != none; vertex = labels_[vertex].parent)
        path_.vertices.push_back(vertex);
    std::reverse(path_.vertices.begin(), path_.vertices.end());
}

}  // namespace camdir::freespace
