// Suggestions for misspelt names.
#pragma once

#include <string>
#include <vector>

namespace camdir::config {

// The candidate with the smallest edit distance to `word`; empty when none is close.
[[nodiscard]] std::string nearest_spelling(const std::string& word,
                                           const std::vector<std::string>& candidates);

}  // namespace camdir::config
