// One method's product as figures: its costs, its sizes, and what `verify` says.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/paper/engines.hpp"
#include "bench/paper/method.hpp"

namespace camdir::paper {

// Runs the method in this process, whose peak of memory is part of the figures. `balls` as for verify.
[[nodiscard]] Result<nlohmann::ordered_json> measure(const Method& method, const scene::Scene& scene,
                                                     const Settings& settings, std::uint64_t balls);

[[nodiscard]] nlohmann::ordered_json to_json(const EngineCost& cost);

}  // namespace camdir::paper
