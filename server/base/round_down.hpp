// Rounding of lower bounds: what is proved in double stays proved in float.
#pragma once

#include <cmath>
#include <limits>

namespace camdir {

// The largest float that is not above the value; NaN stays NaN.
[[nodiscard]] inline float round_down(double value) {
    const auto rounded = static_cast<float>(value);
    if (static_cast<double>(rounded) <= value) return rounded;
    return std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}

}  // namespace camdir
