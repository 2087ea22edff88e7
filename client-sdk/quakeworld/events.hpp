// What happens in the game, in the client library's terms. A player's id is the number of their slot.
#pragma once

#include <camera_director/camera_director.hpp>

#include "quakeworld/frames.hpp"

namespace camdir::qtv {

inline constexpr std::int64_t ns_of_a_ms = 1'000'000;

// `round`: the number of the match within its level, from 1. Of a kill whose text names only one of two team
// mates the other is nobody.
[[nodiscard]] camera_director::MatchEvent event_of(const quakeworld::Occurrence& occurrence,
                                                   std::uint32_t round);

}  // namespace camdir::qtv
