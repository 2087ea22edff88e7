// The match that `evaluate` and `direct` read: a file's, or a director's recording.
#pragma once

#include <filesystem>

#include "app/progress.hpp"
#include "base/error.hpp"
#include "evaluation/match.hpp"

namespace camdir::app {

// The poses and events of players of the recording's last epoch, without spectators; frames whose time does
// not ascend are left out. Recordings do not say how high eyes are: the trace has a standing player's height.
[[nodiscard]] Result<evaluation::RecordedMatch> match_of_recording(const std::filesystem::path& folder);

// Of a file (evaluation::read_match) or of a recording's folder. A warning of what could not be read is
// printed, after `line` is cleared.
[[nodiscard]] Result<evaluation::RecordedMatch> read_match(const std::filesystem::path& path,
                                                           ProgressLine& line);

}  // namespace camdir::app
