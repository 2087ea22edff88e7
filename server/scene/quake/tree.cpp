#include "scene/quake/tree.hpp"

#include <string>
#include <utility>

namespace camdir::scene::quake {
namespace {

constexpr std::size_t max_planes = 256;
// As for the clips that make the leaves.
constexpr double tolerance = 1e-6;

struct Visit {
    std::int32_t child;
    Solid place;
};

struct Part {
    std::int32_t child;
    Polygon polygon;
};

}  // namespace

Tree::Tree(const Bsp& bsp) : bsp_(bsp), steps_left_(bsp.max_surface_steps()) {
    planes_.reserve(bsp.nodes.size());
    for (const Node& node : bsp.nodes)
        planes_.push_back(bsp.plane(node.plane));
}

bool Tree::in_solid_leaf(std::int32_t root, const Vec3d& point) const {
    std::int32_t here = root;
    while (here >= 0)
        here = child(here, plane(here).normal.dot(point) >= plane(here).distance ? 0 : 1);
    return is_solid(here);
}

Result<void> Tree::for_each_solid_leaf(std::int32_t root, const Box3d& box,
                                       const std::function<Result<void>(const Solid&)>& visit) const {
    std::vector<Visit> open;
    open.push_back({root, make_solid(box)});
    while (!open.empty()) {
        const Visit here = std::move(open.back());
        open.pop_back();
        if (here.place.planes.empty()) continue;
        if (here.child < 0) {
            if (!is_solid(here.child)) continue;
            if (const Result<void> visited = visit(here.place); !visited) return visited;
            continue;
        }
        if (here.place.planes.size() > max_planes)
            return fail("lump 5 (nodes): element " + std::to_string(here.child) + ": more than " +
                        std::to_string(max_planes) + " planes bound it; expected a map's tree");
        const scene::Plane& cut = plane(here.child);
        open.push_back({child(here.child, 1), clip(here.place, cut)});
        open.push_back({child(here.child, 0), clip(here.place, flipped(cut))});
    }
    return {};
}

Result<void> Tree::for_each_open_part(std::int32_t root, const SolidFace& face,
                                      const std::function<void(const Polygon&)>& visit) {
    std::vector<Part> open = {{root, face.polygon}};
    while (!open.empty()) {
        if (steps_left_ == 0)
            return fail(
                "lump 5 (nodes): the surface of the solid leaves is in too many parts for a file of "
                "this size; expected a map's tree");
        --steps_left_;
        const Part here = std::move(open.back());
        open.pop_back();
        if (here.child < 0) {
            if (!is_solid(here.child)) visit(here.polygon);
            continue;
        }
        const scene::Plane& cut = plane(here.child);
        if (lies_on(here.polygon, cut, tolerance)) {
            const std::size_t outside = cut.normal.dot(face.normal) >= 0.0 ? 0 : 1;
            open.push_back({child(here.child, outside), here.polygon});
            continue;
        }
        Polygon behind = clip(here.polygon, cut, tolerance);
        Polygon before = clip(here.polygon, flipped(cut), tolerance);
        if (!behind.empty()) open.push_back({child(here.child, 1), std::move(behind)});
        if (!before.empty()) open.push_back({child(here.child, 0), std::move(before)});
    }
    return {};
}

const scene::Plane& Tree::plane(std::int32_t node) const {
    return planes_[static_cast<std::size_t>(node)];
}

std::int32_t Tree::child(std::int32_t node, std::size_t side) const {
    return bsp_.child_of(bsp_.nodes[static_cast<std::size_t>(node)], side);
}

bool Tree::is_solid(std::int32_t leaf_child) const {
    const std::int32_t contents = bsp_.leaves[static_cast<std::size_t>(-(leaf_child + 1))].contents;
    return contents == solid || contents == sky;
}

}  // namespace camdir::scene::quake
