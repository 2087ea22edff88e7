// A trace at another rate.
#pragma once

#include "evaluation/trace.hpp"

namespace camdir::evaluation {

// The trace at `rate_hz` frames a second (> 0), starting at its first frame. Poses are interpolated between
// the two frames around each instant, but not across a discontinuity, a death or an absence: there the
// earlier frame's pose is kept. A discontinuity is marked in the first new frame at or after it. Fails when
// the result would have more than 50 million poses.
[[nodiscard]] Result<Trace> resample(const Trace& trace, double rate_hz);

}  // namespace camdir::evaluation
