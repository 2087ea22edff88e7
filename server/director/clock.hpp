// Times in nanoseconds, of this host's clocks or of a game server's clock.
#pragma once

#include <time.h>

#include <chrono>
#include <cstdint>

namespace camdir::director {

[[nodiscard]] inline std::int64_t now_ns() {
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

// Of the calling thread. A call of the kernel: ten times as long as now_ns().
[[nodiscard]] inline std::int64_t processor_ns() {
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

// Of arbitrary game times: their difference may be too large for an std::int64_t, and is exact but for the
// rounding of the result.
[[nodiscard]] inline double seconds_between(std::int64_t from, std::int64_t to) {
    const auto nanoseconds = [](std::int64_t early, std::int64_t late) {
        return static_cast<double>(static_cast<std::uint64_t>(late) - static_cast<std::uint64_t>(early));
    };
    return (from <= to ? nanoseconds(from, to) : -nanoseconds(to, from)) * 1e-9;
}

}  // namespace camdir::director
