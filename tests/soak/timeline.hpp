// What was seen in a run of chaos. Times are in s since measuring began.
#pragma once

#include <sys/types.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenario.hpp"

namespace camdir::soak {

// What the observers of the real matches have seen together for the time of a slice.
struct Seen {
    std::uint64_t frames = 0;         // with the observer's camera
    std::uint64_t lost = 0;           // pose frames without one
    std::uint64_t stale = 0;          // frames not newer than the one before
    std::uint64_t cuts = 0;           // players of real matches never jump: each has no reason
    std::uint64_t unanswered = 0;     // frames during which the answer was not "accepted"
    std::uint64_t epochs = 0;         // changes of the match's epoch, of which there are none
    double gap_s = 0.0;               // longest time without the observer's camera
    double silent_s = 0.0;            // longest time since an observer's last camera, at the slice's end
    double p50_s = 0.0, p99_s = 0.0;  // from the poses, plus their delay, to the camera's arrival
};

// What a process uses.
struct Usage {
    pid_t process = 0;
    double resident_mib = 0.0;
    std::uint32_t descriptors = 0;
    std::uint32_t threads = 0;
};

struct Slice {
    double begin = 0.0, end = 0.0;
    Seen seen;
    double stall_s = 0.0;  // for so long a thread that does next to nothing was not run
    std::array<std::optional<Usage>, 2> directors;
};

struct ActRecord {
    Act act;
    double begin = 0.0, end = 0.0;
    std::uint64_t invented = 0;  // observers or matches that a director answered
    double waited_s = 0.0;       // of a crowd: its last observer for its camera
    std::string failure;         // empty: it was carried out
};

struct Timeline {
    Scenario scenario;
    std::vector<Slice> slices;    // consecutive
    std::vector<ActRecord> acts;  // by their begin
};

}  // namespace camdir::soak
