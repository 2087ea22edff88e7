// Metrics for programs and for people.
#pragma once

#include <string>

#include "evaluation/metrics.hpp"

namespace camdir::evaluation {

// A JSON object with a key for each figure of Metrics, by the same name; a Spread is an object with the keys
// rms, p95, p99; what was not measured is null; kill_in_view is
// absent where it was not asked for. The same metrics give the same text.
[[nodiscard]] std::string to_json(const Metrics& metrics);

// A table of lines `name value unit`.
[[nodiscard]] std::string to_table(const Metrics& metrics);

}  // namespace camdir::evaluation
