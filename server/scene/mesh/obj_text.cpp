#include "scene/mesh/obj_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <utility>

#include "scene/records/ply.hpp"
#include "scene/records/records.hpp"

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

// Appends `v x y z`.
void append_vertex(std::string& text, const Vec3d& position) {
    text += 'v';
    for (const double coordinate : position) {
        text += ' ';
        append_number(text, coordinate);
    }
}

void append_face(std::string& text, std::span<const std::int64_t> indices) {
    if (indices.empty()) return;
    text += 'f';
    for (const std::int64_t index : indices)
        text += ' ' + std::to_string(index + 1);
    text += '\n';
}

void append_strip(std::string& text, std::span<const std::int64_t> indices) {
    std::size_t begin = 0;  // of the present strip
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] < 0) begin = i + 1;
        if (i < begin + 2) continue;
        // Every other triangle turns the other way.
        std::array<std::int64_t, 3> corners{indices[i - 2], indices[i - 1], indices[i]};
        if ((i - begin) % 2 == 1) std::swap(corners[0], corners[1]);
        append_face(text, corners);
    }
}

// Assimp's line: it ends at a carriage return too.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end);
    return line;
}

bool is_obj_vertex(std::string_view line) {
    return line.starts_with("v ") || line.starts_with("v\t");
}

// Appends the line with the origin subtracted; nothing where it is not a position.
Result<void> append_moved(std::string& text, std::string_view line, const Vec3d& origin) {
    const std::vector<std::string_view> words = words_of(line, blanks);
    if (words.size() < 4) return fail("expected `v x y z`");
    Vec3d position;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<double> number = number_of(words[i + 1]);
        if (!number) return fail("'" + std::string(words[i + 1].substr(0, 40)) + "'; expected a number");
        position[static_cast<Eigen::Index>(i)] = *number;
    }
    // v x y z w is the point (x, y, z) / w.
    const double weight = words.size() == 5 ? number_of(words[4]).value_or(1.0) : 1.0;
    append_vertex(text, position - weight * origin);
    text += line.substr(static_cast<std::size_t>(words[3].end() - line.begin()));
    return {};
}

}  // namespace

Result<Bytes> subtract_origin_from_obj(std::span<const std::byte> bytes, const Vec3d& origin) {
    std::string_view rest = text_of(bytes);
    std::string moved;
    moved.reserve(bytes.size());
    std::size_t number = 1;  // of the line
    while (!rest.empty()) {
        const std::string_view line = take_line(rest);
        if (!is_obj_vertex(line)) {
            moved += line;
        } else if (const auto appended = append_moved(moved, line, origin); !appended) {
            return fail("line " + std::to_string(number) + ": " + appended.error().message);
        }
        if (rest.empty()) break;
        if (rest.front() == '\n' || !rest.starts_with("\r\n")) ++number;
        moved += rest.front();
        rest.remove_prefix(1);
    }
    return to_bytes(moved);
}

Result<bool> keeps_double_precision(std::span<const std::byte> ply) {
    const Result<PlyVertices> vertices = find_ply_vertices(ply);
    if (!vertices) return tl::unexpected(vertices.error());
    return vertices->is_text ||
           std::none_of(vertices->columns.begin(), vertices->columns.end(),
                        [](const Column& column) { return column.type == NumberType::float32; });
}

Result<Bytes> ply_to_obj(std::span<const std::byte> ply, const Vec3d& origin) {
    const Result<std::vector<Vec3d>> points = read_ply_points(ply);
    if (!points) return tl::unexpected(points.error());
    std::string obj;
    for (std::size_t i = 0; i < points->size(); ++i) {
        if (!(*points)[i].allFinite())
            return fail("vertex " + std::to_string(i) + ": expected finite coordinates");
        append_vertex(obj, (*points)[i] - origin);
        obj += '\n';
    }
    const auto append = [&obj](const std::vector<std::int64_t>& indices, bool is_strip) {
        return is_strip ? append_strip(obj, indices) : append_face(obj, indices);
    };
    if (const auto read = visit_ply_faces(ply, points->size(), append); !read)
        return tl::unexpected(read.error());
    return to_bytes(obj);
}

}  // namespace camdir::scene
