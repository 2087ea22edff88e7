#include "evaluation/statistics.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace camdir::evaluation {

double mean(std::span<const double> values) {
    if (values.empty()) return unmeasured;
    double sum = 0.0;
    for (const double value : values)
        sum += value;
    return sum / static_cast<double>(values.size());
}

double root_mean_square(std::span<const double> values) {
    if (values.empty()) return unmeasured;
    double sum = 0.0;
    for (const double value : values)
        sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

double percentile(std::vector<double> values, double share) {
    assert(share >= 0.0 && share <= 1.0);
    if (values.empty()) return unmeasured;
    const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size()));
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(std::min(rank, values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

}  // namespace camdir::evaluation
