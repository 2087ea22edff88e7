// evaluate --group: one camera of several players.
#pragma once

#include <stop_token>

#include "app/evaluate_inputs.hpp"
#include "app/progress.hpp"

namespace camdir::app {

// Runs the group's shot over the match, judges it, and writes what the options ask for. The written cameras
// are the group's, one for every player of a frame.
[[nodiscard]] Result<void> evaluate_group(const EvaluateOptions& options, const Match& match,
                                          const SourceMap& map, ProgressLine& line,
                                          const std::stop_token& stop);

}  // namespace camdir::app
