// The order in which several maps are baked at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/scene.hpp"

namespace camdir::maps {

// Memory that a bake of the scene takes, in bytes, from above: 48 MiB, and 1.5 kB for every sample of the
// obstacles, of which uniform sampling makes at most 1.5 on each d0^2 of their area and one a vertex or
// point, and of the shell. `d0` in map units. Measured on the maps of OpenArena.
[[nodiscard]] std::uint64_t estimate_memory(const scene::Scene& scene, double d0);

// Which job may start: the neediest of those that fit beside what runs into the budget, and any job when
// nothing runs, so that one above the budget runs alone. One thread at a time.
class BakeSchedule {
  public:
    // `needs`: bytes of each job. `budget`: bytes. `slots`: jobs at once, at least 1.
    BakeSchedule(std::vector<std::uint64_t> needs, std::uint64_t budget, std::size_t slots);

    // Starts a job and returns its number; nothing when none may start before a running one is finished.
    [[nodiscard]] std::optional<std::size_t> start();
    void finish(std::size_t job);

    [[nodiscard]] bool all_started() const { return waiting_.empty(); }
    [[nodiscard]] std::size_t running() const { return running_; }

  private:
    std::vector<std::uint64_t> needs_;
    std::uint64_t budget_;
    std::size_t slots_;
    std::vector<std::size_t> waiting_;  // the neediest first, of equals the first
    std::size_t running_ = 0;
    std::uint64_t used_ = 0;  // needs of what runs
};

}  // namespace camdir::maps
