// A running stage of the bake: its progress, its counts, and whether a stop was requested.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <vector>

#include "bake/progress.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"

namespace camdir::bake {

// Used from the thread that runs the stage; `for_each` spreads its body over the threads of the arena.
class Stage {
  public:
    Stage(std::string name, ProgressSink sink, std::stop_token stop);

    // Reports progress, at most every 50 ms and at the end; a `total` of 0 is unknown. False when the stage
    // must end: return interrupted() then.
    [[nodiscard]] bool advance(std::uint64_t done, std::uint64_t total);

    // body(i) for every i < count, in any order and on any thread: it may write only what belongs to i.
    // False when a stop was requested; some bodies did not run then.
    template <class Body>
    [[nodiscard]] bool for_each(std::uint64_t count, const Body& body);

    // For bodies that take long: they should return early when it is true.
    [[nodiscard]] bool stopping() const { return stop_.stop_requested(); }

    // A number for the bake's report.
    void count(std::string what, double value);

    [[nodiscard]] tl::unexpected<Error> interrupted() const;
    [[nodiscard]] StageReport finish() &&;

  private:
    using Clock = std::chrono::steady_clock;

    std::string name_;
    ProgressSink sink_;
    std::stop_token stop_;
    std::vector<freespace::Count> counts_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_{};
};

template <class Body>
bool Stage::for_each(std::uint64_t count, const Body& body) {
    // Slices, so that one thread reports progress between them; grains, so that a stop takes effect soon.
    const std::uint64_t slice = std::clamp<std::uint64_t>(count / 64, 256, 16384);
    const std::uint64_t grain = std::clamp<std::uint64_t>(count / 64, 1, 64);
    for (std::uint64_t first = 0; first < count; first += slice) {
        const std::uint64_t last = std::min(first + slice, count);
        parallel_for_ranges(first, last, grain, [&](std::uint64_t begin, std::uint64_t end) {
            if (stop_.stop_requested()) return;
            for (std::uint64_t i = begin; i != end; ++i)
                body(i);
        });
        if (!advance(last, count)) return false;
    }
    return !stop_.stop_requested();
}

}  // namespace camdir::bake
