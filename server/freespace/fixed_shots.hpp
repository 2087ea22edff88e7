// Fixed shots: cameras that stand still and together have much of a map in their pictures.
#pragma once

#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::freespace {

inline constexpr float fixed_shot_fov = 1.0247783F;  // rad, vertical
// What is farther away is too small in the picture to count, units of 0.0254 m.
inline constexpr float fixed_shot_range = 1500.0F;

// `point` is in the picture and not too far away; obstacles are ignored. `unit`: 0.0254 m in map units.
[[nodiscard]] bool frames(const FixedShot& shot, const Vec3f& point, float unit);

// Lookouts, each with the direction that has the most lookouts in its picture which the shots before it have
// not: at most max_fixed_shots, and none that adds less than a hundredth. Lookouts keep their distance from
// each other, so that their number stands for a volume. Of a large map a sample of them is asked: some tenths
// of a second. Deterministic.
[[nodiscard]] std::vector<FixedShot> find_fixed_shots(const Freespace& freespace);

}  // namespace camdir::freespace
