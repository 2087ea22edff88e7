// Whether a run of chaos was as it should be.
#pragma once

#include <string>
#include <vector>

#include "timeline.hpp"

namespace camdir::soak {

enum class Verdict { passed, failed, not_judged };

struct Check {
    std::string what;
    std::string seen, allowed;
    Verdict verdict = Verdict::failed;
};

[[nodiscard]] std::string name_of(Verdict verdict);
[[nodiscard]] bool is_failed(const Check& check);

// What observers and directors showed around one act.
struct ActFindings {
    double gap_s = 0.0;
    std::uint64_t lost = 0;
    double back_s = 0.0;  // from the act's end until every observer has had a camera again
};

inline constexpr double longest_gap_s = 0.45;  // the lease and as much again, for a busy machine
inline constexpr double longest_absence_s = 1.0;
inline constexpr double least_answered_share = 0.95;  // of what floods invent
inline constexpr double longest_wait_s = 10.0;        // of an observer of a crowd, for its first camera
inline constexpr double max_growth = 0.05;            // of resident memory
inline constexpr double slack_mib =
    8.0;  // more without a warm-up: the first acts need it, and the next again

[[nodiscard]] ActFindings findings_of(const ActRecord& act, const Timeline& timeline);

// Frames are judged where the machine did not stall for half a frame and had no crowd; the share of the time
// where it did not.
[[nodiscard]] double judged_share(const Timeline& timeline);

// Of `sanitized` directors neither memory nor what observers see is judged: sanitizers cost memory and time,
// and a game server that is late for longer than its lease loses its match.
[[nodiscard]] std::vector<Check> judge(const Timeline& timeline, bool sanitized = false);

}  // namespace camdir::soak
