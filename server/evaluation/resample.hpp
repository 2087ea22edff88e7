// A trace at another rate.
#pragma once

#include "evaluation/trace.hpp"

namespace camdir::evaluation {

// The trace at `rate_hz` frames a second (> 0), from its first frame's time on. Poses are interpolated
// between the two frames around each instant, but not across a discontinuity, a death or an absence: there
// the earlier frame's pose holds. A discontinuity is marked at the first frame at or after it. Fails when the
// result would have more than 50 million poses.
[[nodiscard]] Result<Trace> resample(const Trace& trace, double rate_hz);

}  // namespace camdir::evaluation
