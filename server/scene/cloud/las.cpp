#include "scene/cloud/las.hpp"

#include <cassert>
#include <cstdint>
#include <cstring>
#include <string>

#include "scene/records/records.hpp"

namespace camdir::scene {
namespace {

// Bytes of the public header block: of every version, and up to the 64-bit count of version 1.4.
constexpr std::size_t header_size = 227;
constexpr std::size_t header_size_4 = 255;
constexpr std::uint8_t compressed_bits = 0xc0;
constexpr std::size_t smallest_record = 20;

template <class T>
T value_at(std::span<const std::byte> bytes, std::size_t offset) {
    assert(offset + sizeof(T) <= bytes.size());
    T value;
    std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

Vec3d vector_at(std::span<const std::byte> bytes, std::size_t offset) {
    return {value_at<double>(bytes, offset), value_at<double>(bytes, offset + 8),
            value_at<double>(bytes, offset + 16)};
}

// Version 1.4 counts in 64 bits; writers of it may leave the old count 0.
std::uint64_t point_count(std::span<const std::byte> bytes) {
    const bool has_large = value_at<std::uint8_t>(bytes, 25) >= 4 && bytes.size() >= header_size_4;
    const auto large = has_large ? value_at<std::uint64_t>(bytes, 247) : 0;
    return large > 0 ? large : value_at<std::uint32_t>(bytes, 107);
}

}  // namespace

bool is_las(std::span<const std::byte> bytes) {
    return text_of(bytes).starts_with("LASF");
}

Result<std::vector<Vec3d>> read_las(std::span<const std::byte> bytes) {
    if (!is_las(bytes)) return fail("byte 0: expected LASF");
    if (bytes.size() < header_size)
        return fail("ends after " + std::to_string(bytes.size()) + " bytes; expected a header of " +
                    std::to_string(header_size));
    if (value_at<std::uint8_t>(bytes, 24) != 1)
        return fail("byte 24: version " + std::to_string(value_at<std::uint8_t>(bytes, 24)) + "; expected 1");
    if ((value_at<std::uint8_t>(bytes, 104) & compressed_bits) != 0)
        return fail("byte 104: compressed (LAZ); unpack it to LAS first, for example with laszip");
    const std::size_t begin = value_at<std::uint32_t>(bytes, 96);
    const std::size_t record = value_at<std::uint16_t>(bytes, 105);
    const std::uint64_t count = point_count(bytes);
    if (const auto fits = check_point_count(count); !fits) return tl::unexpected(fits.error());
    if (record < smallest_record)
        return fail("byte 105: records of " + std::to_string(record) + " bytes; expected at least " +
                    std::to_string(smallest_record));
    if (begin > bytes.size() || (bytes.size() - begin) / record < count)
        return fail("ends after " + std::to_string(bytes.size()) + " bytes; expected " +
                    std::to_string(count) + " records of " + std::to_string(record) + " from byte " +
                    std::to_string(begin));
    const Vec3d scale = vector_at(bytes, 131);
    const Vec3d offset = vector_at(bytes, 155);
    const auto column = [&](std::size_t place) { return Column{begin + place, record, NumberType::int32}; };
    std::vector<Vec3d> points = read_columns(bytes, {column(0), column(4), column(8)}, count);
    for (Vec3d& point : points)
        point = point.cwiseProduct(scale) + offset;
    return points;
}

}  // namespace camdir::scene
