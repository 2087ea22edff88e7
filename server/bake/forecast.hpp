// What a bake is going to take, known before it takes it: its time and memory follow the number of samples.
#pragma once

#include <cstdint>
#include <string>

#include "bake/progress.hpp"
#include "base/error.hpp"

namespace camdir::bake {

class SampleEstimate;

// The cost of a bake with the sampling distance `d0` (map units) and so many threads: a rough figure.
// `unit` is the length of a nominal unit.
[[nodiscard]] Forecast forecast(const SampleEstimate& estimate, double d0, double unit, unsigned threads);

// Fails when that is more than `memory` bytes; the error names a larger d0 that would fit, if there is one.
// `source` names the map in the error.
[[nodiscard]] Result<void> check_memory(const Forecast& forecast, const SampleEstimate& estimate, double d0,
                                        double unit, std::uint64_t memory, const std::string& source);

}  // namespace camdir::bake
