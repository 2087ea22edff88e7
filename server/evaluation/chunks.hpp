// Random sampling in parallel with the same outcome on any number of threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <random>
#include <stop_token>
#include <vector>

#include "base/parallel.hpp"

namespace camdir::evaluation {

inline constexpr std::uint64_t chunk_size = 2048;

// Random numbers of one chunk: the same for the same seed, purpose and chunk.
class ChunkRandom {
  public:
    ChunkRandom(std::uint64_t seed, std::uint32_t purpose, std::uint64_t chunk) {
        std::seed_seq mixed{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                            purpose, static_cast<std::uint32_t>(chunk),
                            static_cast<std::uint32_t>(chunk >> 32U)};
        engine_.seed(mixed);
    }

    // Uniform in [0, 1).
    [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11U) * 0x1p-53; }
    // Uniform in 0 .. count - 1.
    [[nodiscard]] std::size_t below(std::size_t count) {
        return std::min(static_cast<std::size_t>(uniform() * static_cast<double>(count)), count - 1);
    }

  private:
    std::mt19937_64 engine_;
};

// outcomes[i] = work(first + i) for i < count, on all cores. When `stop` is requested, the chunks that have
// not started are left out: their outcomes are default-constructed. done(k) is called after k chunks, from
// any thread.
template <class Outcome, class Work, class Done>
[[nodiscard]] std::vector<Outcome> run_chunks(std::uint64_t first, std::uint64_t count,
                                              const std::stop_token& stop, const Work& work,
                                              const Done& done) {
    std::vector<Outcome> outcomes(count);
    std::atomic<std::uint64_t> finished = 0;
    parallel_for(std::uint64_t{0}, count, [&](std::uint64_t i) {
        if (stop.stop_requested()) return;
        outcomes[i] = work(first + i);
        done(++finished);
    });
    return outcomes;
}

}  // namespace camdir::evaluation
