// The solid leaves of a Quake or GoldSrc tree: what such maps have for brushes.
#pragma once

#include <functional>

#include "scene/quake_bsp.hpp"
#include "scene/solid.hpp"

namespace camdir::scene::quake {

// Of unit length, in double precision.
[[nodiscard]] scene::Plane to_plane(const Plane& plane);

// Solid or sky: what no camera may enter.
[[nodiscard]] bool is_solid(const Bsp& bsp, std::int32_t leaf_child);

// The point lies in a solid or sky leaf of the tree.
[[nodiscard]] bool in_solid_leaf(const Bsp& bsp, std::int32_t root, const Vec3d& point);

// Calls `visit` with each solid or sky leaf of the tree as a convex solid: the part of `box` on its side of
// every plane on the path from the root. Every plane has its face. Leaves without volume are passed over.
// Fails when more than 256 planes bound a place, which no real map comes near.
[[nodiscard]] Result<void> for_each_solid_leaf(const Bsp& bsp, std::int32_t root, const Box3d& box,
                                               const std::function<Result<void>(const Solid&)>& visit);

}  // namespace camdir::scene::quake
