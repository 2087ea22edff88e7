// A recorded match, played over and over.
#pragma once

#include <cstddef>
#include <memory>

#include "evaluation/match.hpp"
#include "load.hpp"

namespace camdir::soak {

// The frames of a match, beginning with number `first` of its trace, which has at least one. An event comes
// with the first frame that is not before it, those after the last frame with the first one. Where the match
// begins anew all players jump.
[[nodiscard]] MatchFrames replay(std::shared_ptr<const evaluation::RecordedMatch> match, std::size_t first);

}  // namespace camdir::soak
