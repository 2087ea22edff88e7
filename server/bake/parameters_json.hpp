// The codec of what decides a bake's result beside the source: Metadata::parameters of a MAP.vfs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "bake/parameters.hpp"
#include "scene/read_options.hpp"

namespace camdir::bake {

// One JSON object on one line: "kind" (what the source is, unless empty), the parameters without the number
// of threads, and those read options that are not the default. Numbers in their shortest form, so that equal
// bakes have equal texts.
[[nodiscard]] std::string to_json(const Parameters& parameters, const scene::ReadOptions& options,
                                  const std::string& kind = {});

// The read options in such an object. Members that are absent or not of the type that is written are as by
// default.
[[nodiscard]] scene::ReadOptions read_options_in(const nlohmann::json& parameters);

}  // namespace camdir::bake
