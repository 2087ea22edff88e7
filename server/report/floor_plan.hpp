// The match from above: the map, the players, their cameras, and where these were not good.
#pragma once

#include <stop_token>
#include <string>

#include "base/error.hpp"
#include "report/subject.hpp"

namespace camdir::report {

// A picture of the map with tracks over it, a group for each player. Fails as render::draw.
[[nodiscard]] Result<std::string> floor_plan(const Subject& subject, const std::stop_token& stop);

}  // namespace camdir::report
