// Point clouds: PCD, PLY without faces, XYZ, LAS.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "scene/read_options.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

enum class CloudFormat { pcd, ply, xyz, las };

// Skipped and counted: points without a position (PCD's NaN), repeated points, outliers. Refused: fewer than
// four points, other positions that are not finite. Name, source, hash and spawn points are left empty.
[[nodiscard]] Result<Scene> read_cloud_scene(std::span<const std::byte> bytes, CloudFormat format,
                                             const ReadOptions& options);

}  // namespace camdir::scene
