// Which of a map's brush entities are obstacles: one table for all classes of all BSP formats.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace camdir::scene {

enum class BrushUse : std::uint8_t {
    obstacle,
    mover,    // moves, appears or disappears: baked in, it would close what is behind it for good
    none,     // has no body, or is only drawn
    unknown,  // not in the table: no obstacle either, and reported by its class
};

enum class BspFamily : std::uint8_t { quake, quake3 };  // quake: Quake and GoldSrc

// A row of the table in README.md of server/scene.
struct BrushClasses {
    std::string_view names;  // separated by blanks; one that ends in * means all that start so
    bool in_quake, in_quake3;
    BrushUse use;  // not unknown
    std::string_view reason;
};

[[nodiscard]] std::span<const BrushClasses> brush_classes();

[[nodiscard]] std::string_view name_of(BrushUse use);

// The first row that names the class decides.
[[nodiscard]] BrushUse brush_use(BspFamily family, std::string_view class_name);

}  // namespace camdir::scene
