// The entity text of a BSP of whatever version: what stands where.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"
#include "scene/bsp/brush_classes.hpp"

namespace camdir::scene {

// Limit of the numbers in a file: their sums neither overflow nor lose the precision that a bake needs.
inline constexpr float max_coordinate = 1 << 20;

// Views into the text that was parsed.
struct Entity {
    std::size_t number;  // place in the text, from 0
    std::vector<std::pair<std::string_view, std::string_view>> pairs;

    // The first pair with this key; empty when there is none.
    [[nodiscard]] std::string_view value(std::string_view key) const;
    [[nodiscard]] std::string_view class_name() const { return value("classname"); }

    // Key `origin`; zero without it. Fails unless it is three numbers below 2^20.
    [[nodiscard]] Result<Vec3d> origin() const;
    // Keys `angle` or `angles`: radians, 0 when absent or no number.
    [[nodiscard]] double yaw() const;
    // Number of the brush model: `model` is "*N".
    [[nodiscard]] std::optional<std::size_t> brush_model() const;
};

// Groups of quoted pairs in braces. Errors name the byte of the entity lump.
[[nodiscard]] Result<std::vector<Entity>> parse_entities(std::string_view text);

// An entity's brush model, where the entity puts it.
struct PlacedModel {
    std::size_t model;  // 0: the world
    std::string_view class_name;
    BrushUse use;
    Vec3d origin;
};

// The world, then the models of all entities. A model that several entities have is there for the first of
// them, and again for a mover where that is none and for an obstacle where none is. Fails when a model is not
// below `model_count`, when an obstacle or a mover has no valid origin, or when obstacles share a model.
[[nodiscard]] Result<std::vector<PlacedModel>> placed_models(const std::vector<Entity>& entities,
                                                             std::size_t model_count, BspFamily family);

// The class as valid UTF-8 of at most 64 bytes.
[[nodiscard]] std::string class_text(const PlacedModel& placed);

// Why a model that is no obstacle is skipped: "no obstacle: trigger_once". With `has_parts` a mover is kept
// as such.
[[nodiscard]] std::string skip_reason(const PlacedModel& placed, bool has_parts);

// Players appear here: deathmatch, single player, cooperative and team spawn points.
[[nodiscard]] bool is_spawn_point(std::string_view class_name);

}  // namespace camdir::scene
