#pragma once

#include <chrono>
#include <cstdint>

namespace camdir::paper {

// What a part of the work took.
struct Cost {
    double seconds = 0.0;
    double cpu_seconds = 0.0;  // of all threads, user and system

    Cost& operator+=(const Cost& other) {
        seconds += other.seconds;
        cpu_seconds += other.cpu_seconds;
        return *this;
    }
};

// Wall time and this process's processor time, lap by lap.
class Stopwatch {
  public:
    Stopwatch();
    // Since the last lap, or since the construction.
    [[nodiscard]] Cost lap();

  private:
    std::chrono::steady_clock::time_point time_;
    double cpu_seconds_;
};

// The peak of this process's memory so far.
[[nodiscard]] std::uint64_t peak_memory_bytes();

}  // namespace camdir::paper
