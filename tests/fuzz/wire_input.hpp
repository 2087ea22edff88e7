// The bytes of a fuzzer as samples of several topics, made as Cyclone DDS makes them of what arrives.
#pragma once

#include <camera_director.h>
#include <dds/ddsi/ddsi_cdrstream.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

namespace camdir::fuzz {

// One sample: its topic, the length of what follows (two bytes, the lower one first), and its fields in
// XCDR2.
struct WireRecord {
    std::uint8_t topic = 0;
    std::span<const std::uint8_t> fields;
};

// Takes the first record off the bytes; its fields end where the bytes do.
inline std::optional<WireRecord> next_record(std::span<const std::uint8_t>& bytes) {
    if (bytes.size() < 3) return std::nullopt;
    const std::size_t length = bytes[1] + 256U * bytes[2];
    const WireRecord record{bytes[0], bytes.subspan(3, std::min(length, bytes.size() - 3))};
    bytes = bytes.subspan(3 + record.fields.size());
    return record;
}

// Sample is the C type of `type`.
template <class Sample>
class ReceivedSample {
  public:
    ReceivedSample(const dds_topic_descriptor_t& type, std::span<const std::uint8_t> fields) : type_(type) {
        std::vector<std::uint64_t> aligned(fields.size() / 8 + 1);
        char* const bytes = reinterpret_cast<char*>(aligned.data());
        std::copy(fields.begin(), fields.end(), bytes);
        const auto size = static_cast<std::uint32_t>(fields.size());
        std::uint32_t end = 0;
        accepted_ = dds_stream_normalize_data(bytes, &end, size, false, xcdr2, type.m_ops) != nullptr;
        if (!accepted_) return;
        dds_istream_t stream{};
        dds_istream_init(&stream, size, bytes, xcdr2);
        dds_stream_read(&stream, reinterpret_cast<char*>(&sample_), type.m_ops);
    }
    ReceivedSample(const ReceivedSample&) = delete;
    ReceivedSample& operator=(const ReceivedSample&) = delete;
    ~ReceivedSample() { dds_sample_free(&sample_, &type_, DDS_FREE_CONTENTS); }

    // False where Cyclone drops what arrives.
    [[nodiscard]] explicit operator bool() const { return accepted_; }
    [[nodiscard]] const Sample& operator*() const { return sample_; }

  private:
    static constexpr std::uint32_t xcdr2 = 2;

    const dds_topic_descriptor_t& type_;
    Sample sample_{};
    bool accepted_ = false;
};

}  // namespace camdir::fuzz
