#include "scene/cloud/pcd.hpp"

#include <liblzf/lzf.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "scene/records/records.hpp"

namespace camdir::scene {
namespace {

struct Field {
    std::string_view name;
    std::uint64_t size = 4;
    char type = 'F';
    std::uint64_t count = 1;
};

struct PcdHeader {
    std::vector<Field> fields;
    std::optional<std::uint64_t> width, height, points;
    std::string_view data;
};

constexpr std::uint64_t max_fields = 256;
constexpr std::uint64_t max_field_count = 1 << 16;

std::optional<NumberType> number_type(const Field& field) {
    const auto of = [&](std::uint64_t size, char type) { return field.size == size && field.type == type; };
    if (of(4, 'F')) return NumberType::float32;
    if (of(8, 'F')) return NumberType::float64;
    if (of(1, 'I')) return NumberType::int8;
    if (of(2, 'I')) return NumberType::int16;
    if (of(4, 'I')) return NumberType::int32;
    if (of(8, 'I')) return NumberType::int64;
    if (of(1, 'U')) return NumberType::uint8;
    if (of(2, 'U')) return NumberType::uint16;
    if (of(4, 'U')) return NumberType::uint32;
    if (of(8, 'U')) return NumberType::uint64;
    return std::nullopt;
}

using Words = std::vector<std::string_view>;

// After the keyword one word for each field.
template <class Set>
Result<void> set_fields(const Words& words, const Lines& lines, PcdHeader& header, const Set& set) {
    if (words.size() != header.fields.size() + 1)
        return lines.bad_line(std::to_string(words.size() - 1) + " values for " +
                              std::to_string(header.fields.size()) + " fields");
    for (std::size_t i = 0; i < header.fields.size(); ++i) {
        if (!set(header.fields[i], words[i + 1]))
            return lines.bad_line("'" + std::string(words[i + 1].substr(0, 40)) + "' as " +
                                  std::string(words[0]));
    }
    return {};
}

bool set_number(std::string_view word, std::uint64_t max, std::uint64_t& to) {
    const auto number = whole_number(word);
    if (!number || *number == 0 || *number > max) return false;
    to = *number;
    return true;
}

Result<void> set_count(const Words& words, const Lines& lines, std::optional<std::uint64_t>& to) {
    if (words.size() == 2) to = whole_number(words[1]);
    if (!to) return lines.bad_line("expected a whole number after " + std::string(words[0]));
    return {};
}

Result<void> read_entry(const Words& words, const Lines& lines, PcdHeader& header) {
    const std::string_view key = words[0];
    if (key == "FIELDS" || key == "COLUMNS") {
        if (header.fields.size() + words.size() - 1 > max_fields)
            return lines.bad_line("more than 256 fields");
        for (std::size_t i = 1; i < words.size(); ++i)
            header.fields.push_back({words[i]});
        return {};
    }
    if (key == "SIZE")
        return set_fields(words, lines, header,
                          [](Field& f, std::string_view word) { return set_number(word, 8, f.size); });
    if (key == "TYPE")
        return set_fields(words, lines, header, [](Field& f, std::string_view word) {
            f.type = word[0];
            return word == "F" || word == "I" || word == "U";
        });
    if (key == "COUNT")
        return set_fields(words, lines, header, [](Field& f, std::string_view word) {
            return set_number(word, max_field_count, f.count);
        });
    if (key == "WIDTH") return set_count(words, lines, header.width);
    if (key == "HEIGHT") return set_count(words, lines, header.height);
    if (key == "POINTS") return set_count(words, lines, header.points);
    if (key == "VERSION" || key == "VIEWPOINT") return {};
    return lines.bad_line("'" + std::string(key.substr(0, 40)) + "'; expected a keyword of a PCD header");
}

Result<PcdHeader> read_pcd_header(Lines& lines) {
    PcdHeader header;
    while (const auto line = lines.next()) {
        const Words words = words_of(*line);
        if (words.empty() || words[0].starts_with('#')) continue;
        if (words[0] == "DATA") {
            if (words.size() == 2) header.data = words[1];
            return header;
        }
        if (const auto read = read_entry(words, lines, header); !read) return tl::unexpected(read.error());
    }
    return fail("the header has no DATA line");
}

Result<std::uint64_t> point_count(const PcdHeader& header) {
    std::uint64_t count = header.points.value_or(0);
    if (!header.points) {
        const std::uint64_t width = header.width.value_or(0);
        const std::uint64_t height = header.height.value_or(1);
        if (!header.width) return fail("the header has neither POINTS nor WIDTH");
        if (height > 0 && width > max_points / height)
            count = max_points + 1;
        else
            count = width * height;
    }
    if (const auto fits = check_point_count(count); !fits) return tl::unexpected(fits.error());
    return count;
}

std::array<std::size_t, 3> coordinates(const PcdHeader& header) {
    std::array<std::size_t, 3> places{};
    constexpr std::array<std::string_view, 3> names = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto found = std::find_if(header.fields.begin(), header.fields.end(),
                                        [&](const Field& field) { return field.name == names[axis]; });
        places[axis] = static_cast<std::size_t>(found - header.fields.begin());
    }
    return places;
}

std::size_t width_of(const Field& field) {
    return field.size * field.count;
}

std::size_t record_size(const PcdHeader& header) {
    std::size_t size = 0;
    for (const Field& field : header.fields)
        size += width_of(field);
    return size;
}

// Binary data holds point after point, compressed data field after field.
Columns columns_of(const PcdHeader& header, const std::array<std::size_t, 3>& places, bool by_field,
                   std::size_t count) {
    Columns columns{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::size_t offset = 0;
        for (std::size_t i = 0; i < places[axis]; ++i)
            offset += width_of(header.fields[i]) * (by_field ? count : 1);
        const Field& field = header.fields[places[axis]];
        columns[axis] = {offset, by_field ? width_of(field) : record_size(header), *number_type(field)};
    }
    return columns;
}

Result<std::vector<std::byte>> decompress(std::span<const std::byte> data, std::size_t expected) {
    std::array<std::uint32_t, 2> sizes;
    if (data.size() < sizeof sizes) return fail("ends before the sizes of the compressed data");
    std::memcpy(sizes.data(), data.data(), sizeof sizes);
    const auto [compressed, unpacked] = sizes;
    data = data.subspan(sizeof sizes);
    if (compressed > data.size())
        return fail("ends after " + std::to_string(data.size()) + " bytes of compressed data; expected " +
                    std::to_string(compressed));
    if (unpacked != expected)
        return fail("the compressed data holds " + std::to_string(unpacked) + " bytes; the fields need " +
                    std::to_string(expected));
    // Three bytes of LZF unpack to at most 264.
    if (unpacked / 88 > std::uint64_t{compressed} + 1)
        return fail("the compressed data cannot hold the " + std::to_string(unpacked) +
                    " bytes that it promises");
    std::vector<std::byte> bytes(unpacked);
    if (unpacked > 0 && ::lzf_decompress(data.data(), compressed, bytes.data(), unpacked) != unpacked)
        return fail("the compressed data is damaged");
    return bytes;
}

Result<std::vector<Vec3d>> read_binary(std::span<const std::byte> data, const PcdHeader& header,
                                       const std::array<std::size_t, 3>& places, std::size_t count) {
    const bool compressed = header.data == "binary_compressed";
    const std::size_t needed = record_size(header) * count;
    if (compressed) {
        const auto bytes = decompress(data, needed);
        if (!bytes) return tl::unexpected(bytes.error());
        return read_columns(*bytes, columns_of(header, places, true, count), count);
    }
    if (data.size() < needed)
        return fail("ends after " + std::to_string(data.size()) + " bytes of data; expected " +
                    std::to_string(needed));
    return read_columns(data, columns_of(header, places, false, count), count);
}

// Where in a line of text the coordinates are: a field may be several words.
std::array<std::size_t, 3> words_before(const PcdHeader& header, const std::array<std::size_t, 3>& places) {
    std::array<std::size_t, 3> words{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < places[axis]; ++i)
            words[axis] += header.fields[i].count;
    }
    return words;
}

}  // namespace

bool is_pcd(std::span<const std::byte> bytes) {
    Lines lines(text_of(bytes.first(std::min<std::size_t>(bytes.size(), 4096))));
    while (const auto line = lines.next()) {
        if (line->empty() || line->starts_with('#')) continue;
        return line->starts_with("VERSION") || line->starts_with("FIELDS") || line->starts_with("COLUMNS");
    }
    return false;
}

Result<std::vector<Vec3d>> read_pcd(std::span<const std::byte> bytes) {
    Lines lines(text_of(bytes));
    const auto header = read_pcd_header(lines);
    if (!header) return tl::unexpected(header.error());
    const auto count = point_count(*header);
    if (!count) return tl::unexpected(count.error());
    const std::array<std::size_t, 3> places = coordinates(*header);
    for (const std::size_t place : places) {
        if (place == header->fields.size()) return fail("the header has no fields x, y and z");
        if (!number_type(header->fields[place]) || header->fields[place].count != 1)
            return fail("field " + std::string(header->fields[place].name) +
                        ": expected one number of 1, 2, 4 or 8 bytes");
    }
    if (header->data == "ascii") return read_lines(lines, words_before(*header, places), *count);
    if (header->data == "binary" || header->data == "binary_compressed")
        return read_binary(std::as_bytes(std::span(lines.rest())), *header, places, *count);
    return lines.bad_line("expected DATA ascii, binary or binary_compressed");
}

}  // namespace camdir::scene
