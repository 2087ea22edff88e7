// How a source is read where its format leaves a choice.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::scene {

enum class UpAxis : std::uint8_t { y, z };

// "y" or "z": the name in files, the configuration and on the command line.
[[nodiscard]] inline std::string_view name_of(UpAxis axis) {
    return axis == UpAxis::y ? "y" : "z";
}
[[nodiscard]] inline std::optional<UpAxis> up_axis_named(std::string_view name) {
    if (name == name_of(UpAxis::y)) return UpAxis::y;
    if (name == name_of(UpAxis::z)) return UpAxis::z;
    return std::nullopt;
}

struct ReadOptions {
    // Metres of one map unit, > 0. Default: what the format says (BSP 0.0254), else 1.
    std::optional<double> metres_per_unit;
    // Axis that points up in the source. Default: what the format says (glTF y), else z. A source with y up
    // has z forward: its (x, y, z) becomes (z, x, y). Meshes and point clouds only.
    std::optional<UpAxis> up;
    // Point of the source, in its own axes, that becomes (0, 0, 0). Meshes and point clouds only.
    Vec3d origin = Vec3d::Zero();
    // Points of the free space, in map units and axes, in addition to the source's spawn points.
    std::vector<Vec3d> seeds;

    bool operator==(const ReadOptions&) const = default;
};

}  // namespace camdir::scene
