// What a demo says happened, as the events of its trace.
#pragma once

#include <vector>

#include "evaluation/events.hpp"
#include "evaluation/quakeworld/demo.hpp"

namespace camdir::evaluation::quakeworld {

// Kills (detail: weapon), deaths without a killer (detail: cause), damage (hit points) and items (name), in
// the order of the demo. `trace` is that of the demo (trace_of). A kill whose text does not name the killer
// or the victim, a team mate of the other, gets the one whose death, or place, explains it. Left out: what
// concerns nobody of the trace, and damage to others.
[[nodiscard]] std::vector<TraceEvent> events_of(const Demo& demo, const Trace& trace);

}  // namespace camdir::evaluation::quakeworld
