// Waits for a condition.
#pragma once

#include <chrono>
#include <thread>

namespace camdir::test {

// Generous, because only failing tests use it up.
inline constexpr std::chrono::seconds patience{60};

// Polls until the condition holds; false after `limit`.
template <class Condition>
[[nodiscard]] bool eventually(Condition condition, std::chrono::milliseconds limit = patience) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!condition()) {
        if (std::chrono::steady_clock::now() >= end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return true;
}

}  // namespace camdir::test
