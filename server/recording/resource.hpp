// The envelope of `start`, `full` and `delta`: magic, version, sizes, CRC-32, deflated content.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"

namespace camdir::recording {

inline constexpr std::uint8_t major_version = 1;
inline constexpr std::uint8_t minor_version = 3;
inline constexpr std::size_t max_content = 64U << 20U;                  // bytes, inflated
inline constexpr std::size_t max_resource = max_content + (1U << 20U);  // bytes, deflated

enum class ResourceKind : std::uint8_t { start = 1, full = 2, delta = 3 };

struct Resource {
    ResourceKind kind = ResourceKind::start;
    std::uint32_t fragment = 0;   // 0 for start
    std::int64_t begin_time = 0;  // ns: no record of the fragment is earlier
    Bytes content;                // at most max_content bytes
};

[[nodiscard]] Bytes encode(const Resource& resource);

// Errors name `name`, the byte and what was expected. Allocates at most 1,032 times the bytes' size (what
// deflate can expand to), and at most max_content.
[[nodiscard]] Result<Resource> decode_resource(std::span<const std::byte> bytes, const std::string& name);

// Whether the bytes begin as those of this resource do, and are as many; they may be damaged.
[[nodiscard]] bool has_header(std::span<const std::byte> bytes, ResourceKind kind, std::uint32_t fragment);

}  // namespace camdir::recording
