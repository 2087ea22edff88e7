// How often a camera stays below a value, beside other cameras.
#pragma once

#include <string>

#include "report/subject.hpp"

namespace camdir::report {

// A chart of the cumulative distribution of all cameras for each of: deviation from the wanted distance,
// angle off the view direction, acceleration, rotation.
[[nodiscard]] std::string distributions(const Subject& subject);

}  // namespace camdir::report
