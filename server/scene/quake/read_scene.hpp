// Quake and GoldSrc maps: what of a BSP is an obstacle.
#pragma once

#include <cstddef>
#include <span>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

// The bytes start with version 29 (Quake) or 30 (GoldSrc).
[[nodiscard]] bool is_quake_bsp(std::span<const std::byte> bytes);

// Obstacles: the world, and the brush entities that brush_use() says, moved by their origin. Volumes: their
// solid and sky leaves. Surfaces: of these volumes, and the faces that bound none; compilers drop faces (of
// rock behind other entities, of tool textures), so that faces alone would have holes. Skipped: liquids ('!'
// and '*'); the compilers' tool textures (clip, trigger, null, skip, hint, origin), except where they close a
// solid of the world; other entities. Movers: the solid leaves of those that have another face than of
// liquids and tool textures. Name, source and hash of the scene are left empty.
[[nodiscard]] Result<Scene> read_quake_scene(std::span<const std::byte> bytes);

}  // namespace camdir::scene
