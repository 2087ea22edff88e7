// A director's recording as the match that `evaluate` and `direct` read.
#pragma once

#include <filesystem>

#include "base/error.hpp"
#include "evaluation/trace.hpp"

namespace camdir::app {

// The poses of players of the recording's last epoch, without spectators; frames whose time does not ascend
// are left out. Recordings do not say how high eyes are: the trace has a standing player's height.
[[nodiscard]] Result<evaluation::Trace> trace_of_recording(const std::filesystem::path& folder);

// Of a table (evaluation::read_trace) or of a recording's folder.
[[nodiscard]] Result<evaluation::Trace> read_trace(const std::filesystem::path& path);

}  // namespace camdir::app
