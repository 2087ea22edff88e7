// What a camera saw at some moment, in a row of small pictures.
#pragma once

#include <stop_token>
#include <string>

#include "base/error.hpp"
#include "report/moments.hpp"
#include "report/subject.hpp"

namespace camdir::report {

// At most this many pictures a moment: odd, so that a moment of one frame is in the middle.
inline constexpr int strip_length = 7;

// When the strip of a moment begins and ends, seconds since the trace's first frame.
struct Interval {
    double begin, end;
};
[[nodiscard]] Interval strip_interval(const Moment& moment, const evaluation::Trace& trace);

// Pictures of the map with the players as simple figures, the followed player's eye ringed and the middle of
// the picture framed, each with its time and its faults. Fails as render::draw.
[[nodiscard]] Result<std::string> film_strip(const Subject& subject, const Moment& moment,
                                             const std::stop_token& stop);

}  // namespace camdir::report
