// Summaries of samples.
#pragma once

#include <span>
#include <vector>

namespace camdir::evaluation {

// All are NaN for no values.
[[nodiscard]] double mean(std::span<const double> values);
[[nodiscard]] double root_mean_square(std::span<const double> values);

// The value with floor(share * count) values before it when they are sorted; share in 0 .. 1.
[[nodiscard]] double percentile(std::vector<double> values, double share);

}  // namespace camdir::evaluation
