// A recorded match, played over and over.
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "evaluation/match.hpp"
#include "load.hpp"

namespace camdir::soak {

// Whether events of a kind, as tables name it, are part of a match's frames.
[[nodiscard]] bool is_sent(std::string_view kind);

// The frames of a match, beginning with number `first` of its trace, which has at least one. An event comes
// with the first frame that is not before it, a death without a killer as a kill without one; those before
// the first frame and after the last one are left out. Where the match begins anew all players jump.
[[nodiscard]] MatchFrames replay(std::shared_ptr<const evaluation::RecordedMatch> match, std::size_t first);

}  // namespace camdir::soak
