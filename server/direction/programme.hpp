// The programme of a whole match: what the editor would have shown, decision by decision.
#pragma once

#include <functional>
#include <span>
#include <stop_token>
#include <vector>

#include "base/error.hpp"
#include "direction/editor.hpp"

namespace camdir::direction {

// Whether a rush may begin at a beat, or go on where it is on the air.
using MayShow = std::function<bool(std::size_t rush, Beat now, bool on_air)>;

// Shots that follow each other without gaps from the first beat to the last, no two in a row of one rush. At
// every beat that may have a cut the editor knows what happened until `delay_s` (>= 0) later, and nothing
// more; 0: what happened before the beat. `events` ascend by time. `may_show`: at every beat of one rush at
// least; empty: of all. Fails with ErrorCode::interrupted soon after `stop` is requested.
[[nodiscard]] Result<std::vector<Shot>> direct(const Footage& footage, std::span<const Event> events,
                                               const Rules& rules, double unit, double delay_s,
                                               const std::stop_token& stop, const MayShow& may_show = {});

// The programme that shows the most kills by the same grammar, as Figures::kills_seen counts them, for an
// editor who wants nothing else and knows the whole match; what the rules say of moments does not matter.
// Of shots that may be shorter than 1.5 s others may show more: see Rule::worth.
// Precondition: a beat.
[[nodiscard]] std::vector<Shot> direct_for_kills(const Footage& footage, std::span<const Event> events,
                                                 const Rules& rules, double unit);

}  // namespace camdir::direction
