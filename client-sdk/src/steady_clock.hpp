#pragma once

#include <chrono>
#include <cstdint>

namespace camdir::sdk {

// This host's clock that never goes back.
[[nodiscard]] inline std::int64_t steady_ns() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace camdir::sdk
