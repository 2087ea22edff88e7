#include "freespace/check.hpp"

#include <cmath>

#include "freespace/index.hpp"

namespace camdir::freespace {
namespace {

std::string at(const char* what, std::size_t index, const char* flaw) {
    return std::string(what) + " " + std::to_string(index) + " " + flaw;
}

// False for NaN and infinity too.
bool within_limit(float value) {
    return std::abs(value) <= coordinate_limit;
}

std::string flaw_of_vertices(std::span<const Vertex> vertices) {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const Vertex& v = vertices[i];
        const bool sane =
            within_limit(v.x) && within_limit(v.y) && within_limit(v.z) && within_limit(v.free_distance);
        if (!sane) return at("vertex", i, "is not finite or out of range");
    }
    return {};
}

std::string flaw_of_triangles(std::span<const Triangle> triangles, std::size_t vertex_count) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto [a, b, c] = triangles[i];
        if (a >= vertex_count || b >= vertex_count || c >= vertex_count)
            return at("triangle", i, "has a corner that does not exist");
        if (a == b || b == c || c == a) return at("triangle", i, "has a corner twice");
    }
    return {};
}

// A number for the pair, as if drawn at random.
std::uint64_t scatter(std::size_t vertex, std::size_t triangle) {
    std::uint64_t x = (static_cast<std::uint64_t>(vertex) << 32U | triangle) + 0x9e3779b97f4a7c15U;
    x = (x ^ (x >> 29U)) * 0xbf58476d1ce4e5b9U;
    return x ^ (x >> 32U);
}

std::uint64_t scatter_corners(std::span<const Triangle> triangles) {
    std::uint64_t sum = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        sum += scatter(triangles[t].a, t) + scatter(triangles[t].b, t) + scatter(triangles[t].c, t);
    return sum;
}

// The pairs of a vertex and an incident triangle must be the pairs of the triangles' corners. Equal sums
// stand for equal sets, so that both are read in order: looking up each triangle would take most of the time
// of opening.
std::string flaw_of_incidence(const MeshView& mesh) {
    const auto offsets = mesh.incident_offsets;
    const auto incident = mesh.incident_triangles;
    if (offsets.size() != mesh.vertices.size() + 1 || offsets.front() != 0 ||
        offsets.back() != incident.size() || incident.size() != 3 * mesh.triangles.size())
        return "the incidence's size does not fit the mesh";
    std::uint64_t sum = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        if (offsets[v] > offsets[v + 1] || offsets[v + 1] > incident.size())
            return at("vertex", v, "has incident triangles out of range");
        std::size_t least = 0;  // the smallest triangle that may come next: they ascend
        for (std::uint32_t i = offsets[v]; i < offsets[v + 1]; ++i) {
            if (incident[i] < least || incident[i] >= mesh.triangles.size())
                return at("vertex", v, "has incident triangles out of order or that do not exist");
            least = incident[i] + std::size_t{1};
            sum += scatter(v, incident[i]);
        }
    }
    if (sum != scatter_corners(mesh.triangles)) return "the incidence is not that of the triangles";
    return {};
}

// Every node and every triangle must be reached exactly once. In breadth-first order that is a matter of
// counting, and a level ends where the nodes counted at its beginning end.
std::string flaw_of_index(const MeshView& mesh) {
    const auto nodes = mesh.index;
    if (nodes.empty() != mesh.triangles.empty()) return "the index's size does not fit the mesh";
    std::size_t next_node = 1;
    std::size_t next_triangle = 0;
    std::size_t level_end = 0;
    std::uint32_t depth = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (i == level_end) {
            if (++depth > index_depth_limit) return "the index is too deep";
            level_end = next_node;
        }
        if (i >= next_node) return at("index node", i, "is not reached");
        for (std::uint32_t k = 0; k < IndexNode::width; ++k) {
            const IndexChild child(nodes[i].child[k]);
            if (!child.is_leaf()) {
                if (child.index() != next_node++ || child.index() >= nodes.size())
                    return at("index node", i, "has a child out of order");
                continue;
            }
            if (child.count() == 0) continue;
            if (child.count() > IndexChild::leaf_capacity || child.first() != next_triangle)
                return at("index node", i, "has a leaf out of order");
            next_triangle += child.count();
        }
    }
    if (next_triangle != mesh.triangles.size()) return "the index does not hold every triangle";
    return {};
}

std::string flaw_of_hints(const HintGrid& hints, std::size_t triangle_count) {
    // Counts up to 2^20 are exact as floats, and their product fits.
    constexpr std::uint32_t limit = 1U << 20U;
    std::uint64_t cells = 1;
    for (const std::uint32_t count : hints.extent) {
        if (count > limit) return "the grid of hints is too large";
        cells *= count;
    }
    if (cells != hints.triangles.size() || !(hints.cell_size > 0.0F) || !within_limit(hints.cell_size))
        return "the grid of hints does not fit its size";
    for (std::size_t i = 0; i < hints.triangles.size(); ++i)
        if (hints.triangles[i] >= triangle_count && hints.triangles[i] != none)
            return at("hint", i, "is a triangle that does not exist");
    return {};
}

}  // namespace

std::string find_mesh_flaw(std::span<const Vertex> vertices, std::span<const Triangle> triangles) {
    std::string flaw = flaw_of_vertices(vertices);
    if (flaw.empty()) flaw = flaw_of_triangles(triangles, vertices.size());
    return flaw;
}

std::string find_flaw(const MeshView& mesh) {
    std::string flaw = find_mesh_flaw(mesh.vertices, mesh.triangles);
    if (flaw.empty()) flaw = flaw_of_incidence(mesh);
    if (flaw.empty()) flaw = flaw_of_index(mesh);
    if (flaw.empty()) flaw = flaw_of_hints(mesh.hints, mesh.triangles.size());
    return flaw;
}

}  // namespace camdir::freespace
