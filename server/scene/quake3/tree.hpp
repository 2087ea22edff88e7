// Which leaf of the BSP tree a surface looks into.
#pragma once

#include <vector>

#include "scene/bsp/polygon.hpp"
#include "scene/quake3/bsp.hpp"

namespace camdir::scene::q3 {

class Tree {
  public:
    // `bsp` must have passed parse_bsp and outlive the tree.
    explicit Tree(const Bsp& bsp);

    // A part of the polygon, moved a little along `normal`, lies in a leaf of the playable world
    // (cluster >= 0). Surfaces for which this is false face solid rock or the void around the map.
    [[nodiscard]] bool is_seen(const Polygon& polygon, const Vec3d& normal) const;

  private:
    [[nodiscard]] bool is_playable(std::int32_t child) const;

    const Bsp& bsp_;
    std::vector<scene::Plane> planes_;
};

}  // namespace camdir::scene::q3
