// The poses of a demo's players as a trace.
#pragma once

#include <vector>

#include "evaluation/quakeworld/demo.hpp"
#include "evaluation/trace.hpp"

namespace camdir::evaluation::quakeworld {

// The slots of the players in the trace, ascending: player n of the trace is slots[n].
[[nodiscard]] std::vector<Slot> slots_of(const Demo& demo);

// The trace's poses are those of the demo, one by one; times are the demo's own. What the demo does not say
// is the Tracker's. Precondition: at least one frame.
[[nodiscard]] Trace trace_of(const Demo& demo);

}  // namespace camdir::evaluation::quakeworld
