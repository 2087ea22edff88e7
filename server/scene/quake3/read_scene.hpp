// Quake 3 maps: what of a BSP is an obstacle.
#pragma once

#include <cstddef>
#include <span>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

// The bytes start with the signature of a Quake 3 BSP, of whatever version.
[[nodiscard]] bool is_q3_bsp(std::span<const std::byte> bytes);

// Obstacles: solid brushes (those of sky too), solid patches within 1 unit, solid triangle soups, of the
// world and of the brush entities that brush_use() says. A brush's face is kept when part of it looks into
// the playable world. Movers: the solid brushes of those that have any. Name, source and hash of the scene
// are left empty.
[[nodiscard]] Result<Scene> read_q3_scene(std::span<const std::byte> bytes);

}  // namespace camdir::scene
