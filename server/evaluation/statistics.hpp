// Summaries of samples.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace camdir::evaluation {

inline constexpr double unmeasured = std::numeric_limits<double>::quiet_NaN();

// value_of(sample) of those samples of which it was measured.
template <class Samples, class ValueOf>
[[nodiscard]] std::vector<double> measured(const Samples& samples, const ValueOf& value_of) {
    std::vector<double> values;
    for (const auto& sample : samples)
        if (const double value = value_of(sample); !std::isnan(value)) values.push_back(value);
    return values;
}

// All are `unmeasured` for no values.
[[nodiscard]] double mean(std::span<const double> values);
[[nodiscard]] double root_mean_square(std::span<const double> values);

// The value with floor(share * count) values before it when they are sorted; share in 0 .. 1.
[[nodiscard]] double percentile(std::vector<double> values, double share);

}  // namespace camdir::evaluation
