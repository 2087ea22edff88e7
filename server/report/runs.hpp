// Consecutive frames that have something in common.
#pragma once

#include <cstddef>
#include <vector>

namespace camdir::report {

// Frames first .. last - 1.
struct Run {
    std::size_t first, last;

    [[nodiscard]] std::size_t size() const { return last - first; }
};

// The longest runs of those of `count` frames for which holds(frame), ascending.
template <class Holds>
[[nodiscard]] std::vector<Run> runs_where(std::size_t count, const Holds& holds) {
    std::vector<Run> runs;
    for (std::size_t frame = 0; frame < count; ++frame) {
        if (!holds(frame)) continue;
        if (runs.empty() || runs.back().last != frame) runs.push_back({frame, frame});
        runs.back().last = frame + 1;
    }
    return runs;
}

}  // namespace camdir::report
