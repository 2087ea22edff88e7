// Times: nanoseconds of the steady clock, or of a game server's own.
#pragma once

#include <chrono>
#include <cstdint>

namespace camdir::director {

[[nodiscard]] inline std::int64_t now_ns() {
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

// No overflow whatever a game server sends.
[[nodiscard]] inline double seconds_between(std::int64_t from, std::int64_t to) {
    return (static_cast<double>(to) - static_cast<double>(from)) * 1e-9;
}

}  // namespace camdir::director
