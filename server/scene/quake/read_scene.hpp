// Quake and GoldSrc maps: what of a BSP is an obstacle.
#pragma once

#include <cstddef>
#include <span>

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace camdir::scene {

// The bytes start with version 29 (Quake) or 30 (GoldSrc).
[[nodiscard]] bool is_quake_bsp(std::span<const std::byte> bytes);

// Obstacles: the world and the entities that stand still and block the view (func_wall, func_breakable,
// func_conveyor, func_group, func_static, func_detail and its kinds but the illusionary ones), moved by the
// entity's origin. Volumes: their solid and sky leaves. Surfaces: of these volumes, and the faces that bound
// none. Compilers drop faces (of rock behind other entities, of tool textures), so that faces alone would
// have holes. Left out: liquids ('!' and '*'); the compilers' tool textures (clip, trigger, null, skip, hint,
// origin), except where they close a solid of the world; all other entities, as in Quake 3 maps also what
// moves: a door that was baked shut would part the rooms behind it for good. Name, source and hash of the
// scene are left empty.
[[nodiscard]] Result<Scene> read_quake_scene(std::span<const std::byte> bytes);

}  // namespace camdir::scene
