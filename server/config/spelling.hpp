// Did you mean?
#pragma once

#include <string>
#include <vector>

namespace camdir::config {

// The candidate that is fewest insertions, deletions and replacements away from `word`; empty when none is
// near.
[[nodiscard]] std::string nearest_spelling(const std::string& word,
                                           const std::vector<std::string>& candidates);

}  // namespace camdir::config
