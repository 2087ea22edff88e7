// Damage to a MAP.vfs that its hash does not show.
#pragma once

#include <xxhash.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <vector>

namespace camdir::test {

template <class Value>
std::optional<Value> read_at(const std::vector<std::byte>& bytes, std::size_t position) {
    if (bytes.size() < sizeof(Value) || position > bytes.size() - sizeof(Value)) return std::nullopt;
    Value value;
    std::memcpy(&value, bytes.data() + position, sizeof value);
    return value;
}

// Offset of the file's header: the first field of FlatBuffers' root table.
inline std::optional<std::size_t> header_position(const std::vector<std::byte>& bytes) {
    const auto root = read_at<std::uint32_t>(bytes, 0);
    if (!root) return std::nullopt;
    const auto table = read_at<std::int32_t>(bytes, *root);
    if (!table) return std::nullopt;
    const std::int64_t fields = static_cast<std::int64_t>(*root) - *table;
    if (fields < 0) return std::nullopt;
    const auto field = read_at<std::uint16_t>(bytes, static_cast<std::size_t>(fields) + 4);
    if (!field) return std::nullopt;
    return *root + *field;
}

// Repairs size and hash of damaged bytes, so that the checks behind the hash are reached.
inline void reseal(std::vector<std::byte>& bytes) {
    const auto header = header_position(bytes);
    if (!header || !read_at<std::array<std::uint64_t, 3>>(bytes, *header)) return;
    const std::array<std::uint64_t, 2> size_and_no_hash = {bytes.size(), 0};
    std::memcpy(bytes.data() + *header + 8, size_and_no_hash.data(), sizeof size_and_no_hash);
    const std::uint64_t hash = XXH3_64bits(bytes.data(), bytes.size());
    std::memcpy(bytes.data() + *header + 16, &hash, sizeof hash);
}

}  // namespace camdir::test
