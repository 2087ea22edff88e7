// Times in nanoseconds, of this host's steady clock or of a game server's clock.
#pragma once

#include <chrono>
#include <cstdint>

namespace camdir::director {

[[nodiscard]] inline std::int64_t now_ns() {
    return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

// In double: differences of arbitrary game times must not overflow.
[[nodiscard]] inline double seconds_between(std::int64_t from, std::int64_t to) {
    return (static_cast<double>(to) - static_cast<double>(from)) * 1e-9;
}

}  // namespace camdir::director
