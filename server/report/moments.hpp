// The moments of a match at which a camera was at its worst.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "evaluation/judgement.hpp"
#include "report/runs.hpp"

namespace camdir::report {

struct Moment {
    // The most severe first.
    enum class Kind { through, in_solid, jump, hidden, bad, acceleration, turn };
    Kind kind;
    std::size_t player;  // in trace.players
    Run frames;          // of the trace
    double value;  // seconds of a run; of a frame its speed, acceleration or turn in map units or degrees
};

// At most `max`, by kind and the largest value first: steps through obstacles and undeclared jumps by their
// speed, the longest runs of frames in an obstacle, with a hidden eye, and that are not good, the largest
// accelerations and the fastest turns. Two or three of a kind; none within a second of another of the same
// player.
[[nodiscard]] std::vector<Moment> worst_moments(const evaluation::Trace& trace,
                                                std::span<const evaluation::Judgement> judgements,
                                                std::size_t max);

// One line of text, without characters of markup: what was wrong.
[[nodiscard]] std::string describe(const Moment& moment, const evaluation::Trace& trace,
                                   std::span<const evaluation::Judgement> judgements);

}  // namespace camdir::report
