#include "scene/quake3/tree.hpp"

#include <utility>

namespace camdir::scene::q3 {
namespace {

// How far in front of a face its leaf is looked for: more than rounding in the planes, less than any gap
// that could be seen.
constexpr double offset = 0.125;
// Fragments thinner than this belong to the neighbour.
constexpr double tolerance = 0.01;

struct Visit {
    std::int32_t child;
    Polygon polygon;
};

}  // namespace

scene::Plane to_plane(const Plane& plane) {
    return normalized({Vec3d(plane.normal[0], plane.normal[1], plane.normal[2]), plane.distance});
}

Tree::Tree(const Bsp& bsp) : bsp_(bsp) {
    planes_.reserve(bsp.nodes.size());
    for (const Node& node : bsp.nodes) {
        planes_.push_back(to_plane(bsp.planes[static_cast<std::size_t>(node.plane)]));
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
        // On the plane although it was moved: what stands on the plane looks along its own normal.
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
