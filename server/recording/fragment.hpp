// The content of `start`, `full` and `delta`.
#pragma once

#include <array>

#include "recording/bytes.hpp"
#include "recording/records.hpp"
#include "recording/resource.hpp"

namespace camdir::recording {

// What a reader needs once. The players are those of the beginning; MatchInfo records follow their changes.
struct Start {
    director::MatchInfo match;
    std::string director_version;
    std::int64_t fragment_duration = 3'000'000'000;  // ns: a fragment ends with the first record after it
};

inline constexpr std::int64_t max_fragment_duration = 3'600'000'000'000;  // ns

[[nodiscard]] Bytes encode_start(const Start& start);
[[nodiscard]] Result<Start> decode_start(std::span<const std::byte> bytes, const std::string& name);

// Encodes records one after another. Floats keep every bit: the differences are those of the bit patterns.
class RecordEncoder {
  public:
    explicit RecordEncoder(std::int64_t begin_time) : time_(begin_time) {}
    void add(std::int64_t time, const Message& message);
    [[nodiscard]] const Bytes& content() const { return sink_.bytes; }
    [[nodiscard]] std::size_t count() const { return count_; }  // of the records

  private:
    std::int64_t time_;
    std::size_t count_ = 0;
    std::map<std::uint32_t, std::array<std::uint32_t, 10>> poses_;
    std::map<std::uint32_t, std::array<std::uint32_t, 9>> cameras_;
    std::map<std::uint32_t, std::array<std::uint32_t, 7>> movers_;
    ByteSink sink_;
};

// Of one resource. Bounds what its decoding allocates: a record of four bytes becomes one of two hundred.
inline constexpr std::size_t max_records = 1U << 17U;

// Unknown kinds of records are skipped, and so is what a newer minor version appends to a record. Floats
// are finite, quaternions and normals of length 1 within 1e-3, hulls bounded and known records at most
// max_records, or it is an error.
[[nodiscard]] Result<std::vector<Record>> decode_records(const Resource& resource, const std::string& name);

}  // namespace camdir::recording
