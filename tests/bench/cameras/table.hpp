// What many cameras on many matches measured, as one table.
#pragma once

#include <span>
#include <string>

#include "evaluation/metrics.hpp"

namespace camdir::bench {

struct Row {
    std::string match;
    std::string camera;
    evaluation::Metrics metrics;
    double ns_p50 = evaluation::unmeasured;  // of an update of one camera
    double ns_p99 = evaluation::unmeasured;
};

// A line for each row, then for each camera, in the order of its first row, one of its means over the matches
// with the match "mean". Columns are the keys of evaluation::Metrics; a figure that was not measured is empty
// and not part of a mean. acc is in units/s^2, ang_speed in degrees/s, ns in nanoseconds.
[[nodiscard]] std::string to_markdown(std::span<const Row> rows);
[[nodiscard]] std::string to_csv(std::span<const Row> rows);

}  // namespace camdir::bench
