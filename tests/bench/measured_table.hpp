// The figures of all maps as Markdown.
#pragma once

#include <string>
#include <vector>

#include "measured_map.hpp"

namespace camdir::bench {

// A table: its head, a row for each map, and its end, with the median and worst rows and the list of
// failures.
[[nodiscard]] std::string head_of_table();
[[nodiscard]] std::string row_of(const MeasuredMap& map);
[[nodiscard]] std::string end_of_table(const std::vector<MeasuredMap>& maps);

}  // namespace camdir::bench
