// The trees of Quake and GoldSrc maps: what is solid there, and its surface. Such maps have no
// brushes.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "scene/bsp/solid.hpp"
#include "scene/quake/bsp.hpp"

namespace camdir::scene::quake {

// One tree a model, identified by its root, Model::head_nodes[0]. Solid is what no camera may enter: leaves
// with contents solid or sky.
class Tree {
  public:
    // `bsp` must have passed parse_bsp and outlive the tree.
    explicit Tree(const Bsp& bsp);

    [[nodiscard]] bool in_solid_leaf(std::int32_t root, const Vec3d& point) const;

    // Calls `visit` with each solid leaf as a convex solid: the part of `box` on its side of every plane on
    // the path from the root. Every plane has its face. Leaves without volume are skipped. Fails when
    // more than 256 planes bound a place, which no real map comes near.
    [[nodiscard]] Result<void> for_each_solid_leaf(
        std::int32_t root, const Box3d& box, const std::function<Result<void>(const Solid&)>& visit) const;

    // Calls `visit` with each part of a solid leaf's face that looks into a leaf that is not solid: together
    // the surface of what is solid, closed whatever faces the compiler kept. Fails when all calls together
    // take more steps than a map of this size can need.
    [[nodiscard]] Result<void> for_each_open_part(std::int32_t root, const SolidFace& face,
                                                  const std::function<void(const Polygon&)>& visit);

  private:
    [[nodiscard]] const scene::Plane& plane(std::int32_t node) const;
    [[nodiscard]] std::int32_t child(std::int32_t node, std::size_t side) const;
    [[nodiscard]] bool is_solid(std::int32_t leaf_child) const;

    const Bsp& bsp_;
    std::vector<scene::Plane> planes_;  // of the nodes
    std::size_t steps_left_;
};

}  // namespace camdir::scene::quake
