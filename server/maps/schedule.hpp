// The order in which several maps are baked at the same time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace camdir::maps {

// Decides which job may start next: the one with the largest need among those that fit into the budget beside
// the running ones; any job when none runs, so that a job above the budget runs alone. One thread at a time.
class BakeSchedule {
  public:
    // `needs`: bytes of each job. `budget`: bytes. `slots`: jobs that run at the same time, at least 1.
    BakeSchedule(std::vector<std::uint64_t> needs, std::uint64_t budget, std::size_t slots);

    // Starts a job and returns its index; nothing when none may start before a running one ends.
    [[nodiscard]] std::optional<std::size_t> start();
    void finish(std::size_t job);

    [[nodiscard]] bool all_started() const { return waiting_.empty(); }
    [[nodiscard]] std::size_t running() const { return running_; }

  private:
    std::vector<std::uint64_t> needs_;
    std::uint64_t budget_;
    std::size_t slots_;
    std::vector<std::size_t> waiting_;  // largest need first, ties by index
    std::size_t running_ = 0;
    std::uint64_t used_ = 0;  // needs of the running jobs
};

}  // namespace camdir::maps
