// Shortest paths along the edges of V(S): the roadmap of the paper's section 5.3.
#pragma once

#include <cstdint>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

struct RoadmapPath {
    bool found = false;
    float length = 0.0F;                  // from `from` over the vertices to `to`, map units
    std::vector<std::uint32_t> vertices;  // of V(S), in order; empty when not found
};

// A* over the edges of V(S) whose whole length lies in freespace (both ends have d_f > 0).
// Owns the scratch memory of the search, so that repeated searches do not allocate. One thread at a time;
// the freespace must outlive it.
class RoadmapSearch {
  public:
    explicit RoadmapSearch(const Freespace& freespace);

    // From a covered point to a covered point. As in the paper, each end enters the roadmap at a vertex
    // of a slab that contains it; both ends are joined to those vertices inside freespace. The result is
    // valid until the next call.
    [[nodiscard]] const RoadmapPath& find(const Vec3f& from, const Vec3f& to);

  private:
    struct Label {
        float cost;
        std::uint32_t parent;
        std::uint32_t round;  // labels of older rounds count as unset
        bool closed;
    };
    struct Open {
        float estimate;
        std::uint32_t vertex;
    };

    Freespace freespace_;
    std::vector<Label> labels_;
    std::vector<Open> open_;
    std::uint32_t round_ = 0;
    RoadmapPath path_;
};

}  // namespace camdir::freespace
