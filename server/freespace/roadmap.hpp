// The roadmap of the paper's section 5.3 and shortest paths on it: the vertices of V(S) with d_f > 0, and the
// edges of V(S) between them, whose whole length lies in freespace.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "freespace/freespace.hpp"
#include "freespace/roadmap_graph.hpp"
#include "freespace/space.hpp"

namespace camdir::freespace {

[[nodiscard]] inline bool on_roadmap(const Vertex& vertex) {
    return vertex.free_distance > 0.0F;
}

// Two vertices of V(S), the smaller number first.
using RoadmapEdge = std::array<std::uint32_t, 2>;

// Every edge of the roadmap once, ascending.
[[nodiscard]] std::vector<RoadmapEdge> roadmap_edges(const Freespace& freespace);

// Of each vertex of V(S) the smallest vertex that the roadmap joins it to; `none` off the roadmap. Linear
// time.
[[nodiscard]] std::vector<std::uint32_t> roadmap_components(const Freespace& freespace);

struct RoadmapPath {
    bool found = false;
    float length = 0.0F;                  // from `from` over the vertices to `to`, map units
    std::vector<std::uint32_t> vertices;  // of V(S), in order; empty when not found
};

// A* over the roadmap, with bounds by landmarks (Goldberg and Harrelson, Computing the shortest path, 2005).
// Owns the scratch memory of the search and makes what queries look up, so that neither searches nor queries
// allocate afterwards. One thread at a time; keeps the freespace alive.
//
// Entry vertices: the slab with the largest free distance at a point is convex and holds the point and each
// of its corners on the roadmap, so the segments to these corners lie in freespace. The path enters and
// leaves at those that make it shortest. (The paper takes the one nearest to the other end, which may be a
// detour.)
class RoadmapSearch {
  public:
    explicit RoadmapSearch(const Freespace& freespace);

    // The shortest path between two covered points; not found when one of them is not covered or the roadmap
    // does not join them. Ties are broken by vertex number. The result is valid until the next call.
    [[nodiscard]] const RoadmapPath& find(const Vec3f& from, const Vec3f& to) {
        return find(from, to, Space(freespace_));
    }
    // The same over what the movers of the space, which is of the same map, leave of the roadmap and of the
    // ways to it: over no line that goes through one.
    [[nodiscard]] const RoadmapPath& find(const Vec3f& from, const Vec3f& to, const Space& space);

  private:
    struct Label {
        float cost = 0.0F;  // from the start
        std::uint32_t parent = none;
        std::uint32_t round = 0;  // labels of older rounds count as unset
        bool closed = false;
    };
    struct Open {
        float estimate;  // of the whole path
        std::uint32_t vertex;
    };
    // The corners by which a point joins the roadmap.
    struct EntryVertices {
        std::array<std::uint32_t, 3> vertices;
        std::uint32_t count = 0;

        [[nodiscard]] std::span<const std::uint32_t> span() const { return {vertices.data(), count}; }
    };

    // The end of the path. With d of an entry vertex's path from a landmark and e of its way to the end, for
    // each landmark:
    struct Goal {
        Vec3f point;
        Float4 least_sum[2];        // the smallest d + e
        Float4 most_difference[2];  // the largest d - e
    };

    [[nodiscard]] EntryVertices entry_vertices(const Vec3f& point) const;
    [[nodiscard]] Goal goal_at(const Vec3f& point, const EntryVertices& entry) const;
    [[nodiscard]] float least_rest(std::uint32_t vertex, const Goal& goal) const;
    void begin_round();
    void reach(std::uint32_t vertex, std::uint32_t parent, float cost, const Goal& goal);
    void expand(std::uint32_t vertex, const Goal& goal, const Space& space);
    [[nodiscard]] bool is_free(const Space& space, const Vec3f& point, std::uint32_t vertex) const;
    void trace(std::uint32_t last, float length);

    Freespace freespace_;
    std::vector<Label> labels_;
    std::vector<Open> open_;  // a heap, the smallest estimate first
    std::uint32_t round_ = 0;
    RoadmapPath path_;
};

}  // namespace camdir::freespace
