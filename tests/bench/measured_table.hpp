// The figures of all maps as Markdown.
#pragma once

#include <string>
#include <vector>

#include "measured_map.hpp"

namespace camdir::bench {

// A table with a row a map, its median and worst rows, and the list of failures.
[[nodiscard]] std::string table_of(const std::vector<MeasuredMap>& maps);

}  // namespace camdir::bench
