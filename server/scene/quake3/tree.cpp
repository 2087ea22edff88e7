#include "scene/quake3/tree.hpp"

#include <utility>

namespace camdir::scene::q3 {
namespace {

// A face's leaf is looked up this far in front of it: more than rounding in the planes, less than any
// visible gap.
constexpr double offset = 0.125;
// Fragments thinner than this belong to the neighbour.
constexpr double tolerance = 0.01;

struct Visit {
    std::int32_t child;
    Polygon polygon;
};

}  // namespace

Tree::Tree(const Bsp& bsp) : bsp_(bsp) {
    planes_.reserve(bsp.nodes.size());
    for (const Node& node : bsp.nodes) {
        planes_.push_back(bsp.plane(node.plane));
    }
}

bool Tree::is_seen(const Polygon& polygon, const Vec3d& normal) const {
    Polygon shifted = polygon;
    for (Vec3d& corner : shifted) {
        corner += normal * offset;
    }
    std::vector<Visit> open;
    open.push_back({0, std::move(shifted)});
    while (!open.empty()) {
        const Visit visit = std::move(open.back());
        open.pop_back();
        if (visit.child < 0) {
            if (is_playable(visit.child)) return true;
            continue;
        }
        const auto node = static_cast<std::size_t>(visit.child);
        const auto& [front, back] = bsp_.nodes[node].children;
        const scene::Plane& plane = planes_[node];
        Polygon before = clip(visit.polygon, flipped(plane), tolerance);
        Polygon behind = clip(visit.polygon, plane, tolerance);
        // Still on the plane after the shift: the normal decides the side.
        if (before.empty() && behind.empty())
            (plane.normal.dot(normal) >= 0.0 ? before : behind) = visit.polygon;
        if (!before.empty()) open.push_back({front, std::move(before)});
        if (!behind.empty()) open.push_back({back, std::move(behind)});
    }
    return false;
}

bool Tree::is_playable(std::int32_t child) const {
    return bsp_.leaves[static_cast<std::size_t>(-(child + 1))].cluster >= 0;
}

}  // namespace camdir::scene::q3
