// `sync`: which fragments exist. The only resource that changes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/error.hpp"

namespace camdir::recording {

struct Sync {
    std::uint32_t first = 0;
    std::uint32_t last = 0;  // complete, and so is every fragment between
};

inline constexpr std::size_t max_sync = 4096;  // bytes

[[nodiscard]] std::string encode(const Sync& sync);
[[nodiscard]] Result<Sync> decode_sync(std::span<const std::byte> bytes, const std::string& name);

}  // namespace camdir::recording
