// Directors to compare with, over the same rushes: rebuilt from published descriptions of what others do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "direction/editor.hpp"

namespace camdir::direction {

// Somebody else every 6 s, whoever lives; by the seed.
[[nodiscard]] std::vector<Shot> random_switch(const Footage& footage, std::uint64_t seed);

// The rules of HLTV: shots of 4 to 8 s, usually 6; with a delay of at least 10 s the kills of the next 8 s in
// buckets of 2 s, those 2 to 4 s ahead first, held for 2 s behind; else whoever sees most, by the sum of
// facing^2 / sqrt(distance) over the visible players within 1,024 units of 0.0254 m (`unit`).
[[nodiscard]] std::vector<Shot> hltv(const Footage& footage, std::span<const Event> events, double unit,
                                     double delay_s);

// The rules of a QuakeWorld server's automatic tracking: whoever has most by kills and what they carry (an
// item event's value, until they die), looked at every 0.5 s; the dead are left after 2 s.
[[nodiscard]] std::vector<Shot> quakeworld(const Footage& footage, std::span<const Event> events);

}  // namespace camdir::direction
