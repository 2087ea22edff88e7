#include "freespace/roadmap.hpp"

#include <algorithm>
#include <limits>

#include "freespace/distance.hpp"

namespace camdir::freespace {
namespace {

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
    const auto components = freespace.roadmap().components();
    return {components.begin(), components.end()};
}

RoadmapSearch::RoadmapSearch(const Freespace& freespace)
    : freespace_(freespace), labels_(freespace.vertices().size()) {
    (void)freespace.octree();
    // Each vertex is expanded once, over each of its arcs.
    open_.reserve(freespace.roadmap().arc_count() + 3);
    path_.vertices.reserve(freespace.vertices().size());
}

RoadmapSearch::EntryVertices RoadmapSearch::entry_vertices(const Vec3f& point) const {
    EntryVertices entry;
    const Distance slab = distance(freespace_, point);
    if (!slab.covered()) return entry;
    const auto [a, b, c] = freespace_.triangles()[slab.triangle];
    for (const std::uint32_t corner : {a, b, c})
        if (on_roadmap(freespace_.vertices()[corner])) entry.vertices[entry.count++] = corner;
    return entry;
}

// The entry vertices of a point are corners of one slab and so in one component.
const RoadmapPath& RoadmapSearch::find(const Vec3f& from, const Vec3f& to, const Space& space) {
    path_.found = false;
    path_.length = 0.0F;
    path_.vertices.clear();
    const EntryVertices start = entry_vertices(from);
    const EntryVertices goal = entry_vertices(to);
    if (start.count == 0 || goal.count == 0) return path_;
    const auto components = freespace_.roadmap().components();
    if (components[start.vertices[0]] != components[goal.vertices[0]]) return path_;

    begin_round();
    const Goal bounds = goal_at(to, goal);
    for (const std::uint32_t vertex : start.span())
        if (is_free(space, from, vertex))
            reach(vertex, none, (freespace_.vertices()[vertex].position() - from).norm(), bounds);
    float best_length = std::numeric_limits<float>::infinity();
    std::uint32_t last = none;
    while (!open_.empty()) {
        std::pop_heap(open_.begin(), open_.end(), later);
        const auto [estimate, vertex] = open_.back();
        open_.pop_back();
        if (labels_[vertex].closed) continue;
        labels_[vertex].closed = true;
        // No open vertex promises less than the best way to the goal yet.
        if (estimate >= best_length) break;
        if (std::ranges::find(goal.span(), vertex) != goal.span().end() && is_free(space, to, vertex)) {
            const float length =
                labels_[vertex].cost + (freespace_.vertices()[vertex].position() - to).norm();
            if (length < best_length) {
                best_length = length;
                last = vertex;
            }
        }
        expand(vertex, bounds, space);
    }
    if (last != none) trace(last, best_length);
    return path_;
}

void RoadmapSearch::begin_round() {
    open_.clear();
    if (++round_ != 0) return;
    std::fill(labels_.begin(), labels_.end(), Label{});
    round_ = 1;
}

RoadmapSearch::Goal RoadmapSearch::goal_at(const Vec3f& point, const EntryVertices& entry) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Goal goal{point, {}, {}};
    for (int part = 0; part < 2; ++part) {
        goal.least_sum[part] = broadcast(infinity);
        goal.most_difference[part] = broadcast(-infinity);
        for (const std::uint32_t vertex : entry.span()) {
            const float rest = (freespace_.vertices()[vertex].position() - point).norm();
            const Float4 distances = freespace_.roadmap().landmarks(vertex).part[part];
            goal.least_sum[part] = smaller(goal.least_sum[part], distances + rest);
            goal.most_difference[part] = larger(goal.most_difference[part], distances - rest);
        }
    }
    return goal;
}

// What is left from a vertex to the goal is at least the straight line, and at least the difference of the
// paths from a landmark to the two.
float RoadmapSearch::least_rest(std::uint32_t vertex, const Goal& goal) const {
    const float straight = (freespace_.vertices()[vertex].position() - goal.point).norm();
    const RoadmapGraph::Landmarks& landmarks = freespace_.roadmap().landmarks(vertex);
    Float4 bound = larger(goal.least_sum[0] - landmarks.part[0], landmarks.part[0] - goal.most_difference[0]);
    bound = larger(bound, goal.least_sum[1] - landmarks.part[1]);
    bound = larger(bound, landmarks.part[1] - goal.most_difference[1]);
    // Not more than the truth, but for the rounding of the landmarks' sums: by so much a path may be longer
    // than the shortest.
    return std::max(straight, largest(bound)) * (1.0F - 1e-5F);
}

void RoadmapSearch::reach(std::uint32_t vertex, std::uint32_t parent, float cost, const Goal& goal) {
    Label& label = labels_[vertex];
    if (label.round == round_ && (label.closed || label.cost <= cost)) return;
    label = {cost, parent, round_, false};
    open_.push_back({cost + least_rest(vertex, goal), vertex});
    std::push_heap(open_.begin(), open_.end(), later);
}

void RoadmapSearch::expand(std::uint32_t vertex, const Goal& goal, const Space& space) {
    const float cost = labels_[vertex].cost;
    const Vec3f position = freespace_.vertices()[vertex].position();
    for (const RoadmapGraph::Arc& arc : freespace_.roadmap().arcs(vertex))
        if (is_free(space, position, arc.to)) reach(arc.to, vertex, cost + arc.length, goal);
}

bool RoadmapSearch::is_free(const Space& space, const Vec3f& point, std::uint32_t vertex) const {
    return !space.has_movers() ||
           space.mover_sweep(point, freespace_.vertices()[vertex].position(), 0.0F).clear;
}

void RoadmapSearch::trace(std::uint32_t last, float length) {
    path_.found = true;
    path_.length = length;
    for (std::uint32_t vertex = last; vertex != none; vertex = labels_[vertex].parent)
        path_.vertices.push_back(vertex);
    std::reverse(path_.vertices.begin(), path_.vertices.end());
}

}  // namespace camdir::freespace
