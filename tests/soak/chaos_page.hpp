// A page of HTML about a run of chaos: the verdict, the acts, and what was seen over time. One file that
// needs no other, no network and no script.
#pragma once

#include <string>
#include <vector>

#include "timeline.hpp"
#include "verdict.hpp"

namespace camdir::soak {

[[nodiscard]] std::string to_html(const Timeline& timeline, const std::vector<Check>& checks);

}  // namespace camdir::soak
