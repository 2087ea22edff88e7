// How dense a point cloud is around each of its points.
#pragma once

#include <vector>

#include "base/geometry.hpp"

namespace camdir::scene {

// Mean distance from each point to its `count` nearest neighbours. There must be more than `count` points.
[[nodiscard]] std::vector<double> neighbour_distances(const std::vector<Vec3d>& points, std::size_t count);

}  // namespace camdir::scene
