#include "scene/quake_tree.hpp"

#include <utility>

namespace camdir::scene::quake {
namespace {

constexpr std::size_t max_planes = 256;

struct Visit {
    std::int32_t child;
    Solid place;
};

scene::Plane plane_of(const Bsp& bsp, std::int32_t node) {
    return to_plane(bsp.planes[static_cast<std::size_t>(bsp.nodes[static_cast<std::size_t>(node)].plane)]);
}

std::int32_t child_of(const Bsp& bsp, std::int32_t node, std::size_t side) {
    return bsp.child_of(bsp.nodes[static_cast<std::size_t>(node)], side);
}

}  // namespace

scene::Plane to_plane(const Plane& plane) {
    const Vec3d normal(plane.normal[0], plane.normal[1], plane.normal[2]);
    const double length = normal.norm();
    return {normal / length, plane.distance / length};
}

bool is_solid(const Bsp& bsp, std::int32_t leaf_child) {
    const std::int32_t contents = bsp.leaves[static_cast<std::size_t>(-(leaf_child + 1))].contents;
    return contents == solid || contents == sky;
}

bool in_solid_leaf(const Bsp& bsp, std::int32_t root, const Vec3d& point) {
    std::int32_t child = root;
    while (child >= 0) {
        const scene::Plane plane = plane_of(bsp, child);
        child = child_of(bsp, child, plane.normal.dot(point) >= plane.distance ? 0 : 1);
    }
    return is_solid(bsp, child);
}

Result<void> for_each_solid_leaf(const Bsp& bsp, std::int32_t root, const Box3d& box,
                                 const std::function<Result<void>(const Solid&)>& visit) {
    std::vector<Visit> open;
    open.push_back({root, make_solid(box)});
    while (!open.empty()) {
        const Visit here = std::move(open.back());
        open.pop_back();
        if (here.place.planes.empty()) continue;
        if (here.child < 0) {
            if (!is_solid(bsp, here.child)) continue;
            if (const Result<void> visited = visit(here.place); !visited) return visited;
            continue;
        }
        if (here.place.planes.size() > max_planes)
            return fail("lump 5 (nodes): element " + std::to_string(here.child) + ": more than " +
                        std::to_string(max_planes) + " planes bound it; expected a map's tree");
        const scene::Plane plane = plane_of(bsp, here.child);
        open.push_back({child_of(bsp, here.child, 1), cut_behind(here.place, plane)});
        open.push_back({child_of(bsp, here.child, 0),
                        cut_behind(here.place, scene::Plane{-plane.normal, -plane.distance})});
    }
    return {};
}

}  // namespace camdir::scene::quake
