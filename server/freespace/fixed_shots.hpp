// Fixed shots: cameras that stand still and together have much of a map in their pictures.
#pragma once

#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

// The picture: 90 degrees across in the format 16:9, as tangents of half its angles.
inline constexpr float fixed_shot_tan_across = 1.0F;
inline constexpr float fixed_shot_tan_up = 9.0F / 16.0F;
inline constexpr float fixed_shot_fov = 1.0247789F;  // rad, vertical: 2 atan(9/16)
// A player who is farther away is too small in the picture to count, units of 0.0254 m.
inline constexpr float fixed_shot_range = 900.0F;
// That movers leave a fixed shot, units of 0.0254 m.
inline constexpr float fixed_shot_room = 8.0F;

// `point` is in the picture and not too far away; obstacles are ignored. `unit`: 0.0254 m in map units.
[[nodiscard]] bool frames(const FixedShot& shot, const Vec3f& point, float unit);

// Lookouts, each with the direction that has the most lookouts in its picture which the shots before it have
// not: at most max_fixed_shots, none that adds less than a hundredth, and none at a mover's rest. Lookouts
// keep their distance from each other, so that their number stands for a volume. Of a large map a sample of
// them is asked: some tenths of a second. Deterministic.
[[nodiscard]] std::vector<FixedShot> find_fixed_shots(const Freespace& freespace);

}  // namespace camdir::freespace
