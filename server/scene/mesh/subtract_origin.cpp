#include "scene/mesh/subtract_origin.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <string>

#include "scene/cloud/ply.hpp"
#include "scene/cloud/records.hpp"

namespace camdir::scene {
namespace {

Bytes to_bytes(std::string_view text) {
    const auto* const first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

void append_number(std::string& text, double number) {
    std::array<char, 32> digits{};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), number);
    text.append(digits.data(), error == std::errc() ? end : digits.data());
}

// Appends the row of words with the origin subtracted from those at `places`. `lines` is at that row.
Result<void> append_row(std::string& text, const Lines& lines, const std::vector<std::string_view>& words,
                        const std::array<std::size_t, 3>& places, const Vec3d& origin) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0) text += ' ';
        const auto place = std::find(places.begin(), places.end(), i);
        if (place == places.end()) {
            text += words[i];
            continue;
        }
        const std::optional<double> number = number_of(words[i]);
        if (!number)
            return lines.bad_line("'" + std::string(words[i].substr(0, 40)) + "'; expected a number");
        append_number(text, *number - origin[place - places.begin()]);
    }
    text += '\n';
    return {};
}

bool is_obj_vertex(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return line.starts_with("v ") || line.starts_with("v\t");
}

Result<Bytes> subtract_from_text(std::span<const std::byte> bytes, PlyVertices vertices,
                                 const Vec3d& origin) {
    Lines& lines = vertices.lines;
    const std::size_t needed = *std::max_element(vertices.places.begin(), vertices.places.end()) + 1;
    std::string moved(text_of(bytes.first(bytes.size() - lines.rest().size())));
    for (std::uint64_t i = 0; i < vertices.count; ++i) {
        const auto line = lines.next();
        if (!line)
            return fail("ends after " + std::to_string(i) + " vertices; the header promises " +
                        std::to_string(vertices.count));
        const std::vector<std::string_view> words = words_of(*line);
        if (words.size() < needed)
            return lines.bad_line(std::to_string(words.size()) + " numbers; expected at least " +
                                  std::to_string(needed));
        const Result<void> appended = append_row(moved, lines, words, vertices.places, origin);
        if (!appended) return tl::unexpected(appended.error());
    }
    moved += lines.rest();
    return to_bytes(moved);
}

Bytes subtract_from_doubles(std::span<const std::byte> bytes, const PlyVertices& vertices,
                            const Vec3d& origin) {
    Bytes moved(bytes.begin(), bytes.end());
    const std::vector<Vec3d> points =
        read_columns(bytes, vertices.columns, vertices.count, vertices.big_endian);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3d point = points[i] - origin;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<std::byte, sizeof(double)> number;
            std::memcpy(number.data(), &point[static_cast<Eigen::Index>(axis)], number.size());
            if (vertices.big_endian) std::reverse(number.begin(), number.end());
            const Column& column = vertices.columns[axis];
            std::copy(number.begin(), number.end(),
                      moved.begin() + static_cast<std::ptrdiff_t>(column.offset + i * column.stride));
        }
    }
    return moved;
}

}  // namespace

Result<Bytes> subtract_origin_from_obj(std::span<const std::byte> bytes, const Vec3d& origin) {
    Lines lines(text_of(bytes));
    std::string moved;
    moved.reserve(bytes.size());
    while (const auto line = lines.next()) {
        if (!is_obj_vertex(*line)) {
            moved.append(*line) += '\n';
            continue;
        }
        const std::vector<std::string_view> words = words_of(*line);
        if (words.size() < 4) return lines.bad_line("expected `v x y z`");
        // v x y z w is the point (x, y, z) / w.
        const double weight = words.size() == 5 ? number_of(words[4]).value_or(1.0) : 1.0;
        const Result<void> appended = append_row(moved, lines, words, {1, 2, 3}, origin * weight);
        if (!appended) return tl::unexpected(appended.error());
    }
    return to_bytes(moved);
}

Result<std::optional<Bytes>> subtract_origin_from_ply(std::span<const std::byte> bytes, const Vec3d& origin) {
    const Result<PlyVertices> vertices = find_ply_vertices(bytes);
    if (!vertices) return tl::unexpected(vertices.error());
    const auto all_are = [&](NumberType type, NumberType or_type) {
        return std::all_of(vertices->columns.begin(), vertices->columns.end(), [&](const Column& column) {
            return column.type == type || column.type == or_type;
        });
    };
    if (vertices->is_text && all_are(NumberType::float64, NumberType::float32))
        return subtract_from_text(bytes, *vertices, origin).map([](Bytes moved) {
            return std::optional(std::move(moved));
        });
    if (!vertices->is_text && all_are(NumberType::float64, NumberType::float64))
        return subtract_from_doubles(bytes, *vertices, origin);
    return std::nullopt;
}

}  // namespace camdir::scene
