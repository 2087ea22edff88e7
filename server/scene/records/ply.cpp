#include "scene/records/ply.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "scene/records/records.hpp"

namespace camdir::scene {
namespace {

struct Property {
    std::string_view name;
    std::optional<NumberType> type;        // none: a list, whose length differs from row to row
    NumberType count_type{}, item_type{};  // of a list
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct PlyHeader {
    std::string_view format;
    std::vector<Element> elements;
};

constexpr std::size_t max_properties = 256;

std::optional<NumberType> number_type(std::string_view name) {
    static const std::map<std::string_view, NumberType> types = {
        {"char", NumberType::int8},      {"int8", NumberType::int8},       {"uchar", NumberType::uint8},
        {"uint8", NumberType::uint8},    {"short", NumberType::int16},     {"int16", NumberType::int16},
        {"ushort", NumberType::uint16},  {"uint16", NumberType::uint16},   {"int", NumberType::int32},
        {"int32", NumberType::int32},    {"uint", NumberType::uint32},     {"uint32", NumberType::uint32},
        {"float", NumberType::float32},  {"float32", NumberType::float32}, {"double", NumberType::float64},
        {"float64", NumberType::float64}};
    const auto found = types.find(name);
    return found == types.end() ? std::nullopt : std::optional(found->second);
}

using Words = std::vector<std::string_view>;

Result<void> add_element(const Words& words, const Lines& lines, PlyHeader& header) {
    const auto count = words.size() == 3 ? whole_number(words[2]) : std::nullopt;
    if (!count) return lines.bad_line("expected `element NAME COUNT`");
    if (header.elements.size() == max_properties) return lines.bad_line("more than 256 elements");
    header.elements.push_back({words[1], *count, {}});
    return {};
}

Result<void> add_property(const Words& words, const Lines& lines, PlyHeader& header) {
    if (header.elements.empty()) return lines.bad_line("a property before any element");
    std::vector<Property>& properties = header.elements.back().properties;
    if (properties.size() == max_properties) return lines.bad_line("more than 256 properties");
    if (words.size() == 5 && words[1] == "list") {
        const auto count_type = number_type(words[2]);
        const auto item_type = number_type(words[3]);
        if (!count_type || !item_type)
            return lines.bad_line("expected `property list TYPE TYPE NAME` with numbers' types");
        properties.push_back({words[4], std::nullopt, *count_type, *item_type});
        return {};
    }
    const auto type = words.size() == 3 ? number_type(words[1]) : std::nullopt;
    if (!type) return lines.bad_line("expected `property TYPE NAME` with a number's type");
    properties.push_back({words[2], type});
    return {};
}

Result<PlyHeader> read_ply_header(Lines& lines) {
    PlyHeader header;
    if (lines.next() != "ply") return lines.bad_line("expected `ply`");
    while (const auto line = lines.next()) {
        const Words words = words_of(*line);
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        Result<void> read;
        if (words[0] == "end_header") return header;
        if (words[0] == "format" && words.size() == 3)
            header.format = words[1];
        else if (words[0] == "element")
            read = add_element(words, lines, header);
        else if (words[0] == "property")
            read = add_property(words, lines, header);
        else
            read = lines.bad_line("'" + std::string(words[0].substr(0, 40)) + "'; expected a PLY header");
        if (!read) return tl::unexpected(read.error());
    }
    return fail("the header has no end_header");
}

// Bytes of a row; nothing for rows with lists.
std::optional<std::size_t> row_size(const Element& element) {
    std::size_t size = 0;
    for (const Property& property : element.properties) {
        if (!property.type) return std::nullopt;
        size += size_of(*property.type);
    }
    return size;
}

Result<std::array<std::size_t, 3>> coordinates(const Element& vertex) {
    std::array<std::size_t, 3> places{};
    constexpr std::array<std::string_view, 3> names = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto found = std::find_if(vertex.properties.begin(), vertex.properties.end(),
                                        [&](const Property& p) { return p.name == names[axis]; });
        if (found == vertex.properties.end() || !found->type)
            return fail("the element vertex has no properties x, y and z");
        places[axis] = static_cast<std::size_t>(found - vertex.properties.begin());
        const auto is_list = [](const Property& p) { return !p.type; };
        if (std::any_of(vertex.properties.begin(), found, is_list))
            return fail("the element vertex has a list before its coordinates");
    }
    return places;
}

// A row of text: the words of the next line that is neither blank nor a comment; none at the end.
Words next_row(Lines& lines) {
    while (const auto line = lines.next()) {
        Words words = words_of(*line, blanks);
        if (!words.empty() && !words.front().starts_with('#')) return words;
    }
    return {};
}

// Passes the rows of `element`.
Result<void> skip_rows(const Element& element, bool is_text, Lines& lines) {
    if (is_text) {
        for (std::uint64_t i = 0; i < element.count && !next_row(lines).empty(); ++i) {
        }
        return {};
    }
    const auto size = row_size(element);
    if (!size) return fail("element " + std::string(element.name) + ": lists are not read here");
    if (*size > 0 && lines.rest().size() / *size < element.count)
        return fail("element " + std::string(element.name) + ": ends after " +
                    std::to_string(lines.rest().size()) + " bytes; expected " +
                    std::to_string(element.count) + " rows of " + std::to_string(*size));
    lines.skip(*size * element.count);
    return {};
}

// `begin` is the byte of the first row. Of text only the types mean something.
Columns columns_of(const Element& vertex, const std::array<std::size_t, 3>& places, std::size_t begin) {
    Columns columns{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::size_t offset = begin;
        for (std::size_t i = 0; i < places[axis]; ++i)
            offset += size_of(*vertex.properties[i].type);
        columns[axis] = {offset, row_size(vertex).value_or(0), *vertex.properties[places[axis]].type};
    }
    return columns;
}

// Reads rows with lists, number by number.
class RowReader {
  public:
    RowReader(Lines& lines, std::string_view format)
        : lines_(lines), is_text_(format == "ascii"), big_endian_(format == "binary_big_endian") {}

    // The numbers of the list `wanted` in the next row; nothing where the row is incomplete or has something
    // else than numbers.
    std::optional<std::vector<double>> list(const Element& element, const Property& wanted) {
        if (is_text_) row_ = next_row(lines_);
        next_word_ = 0;
        std::vector<double> numbers;
        for (const Property& property : element.properties) {
            const auto length = property.type ? 1.0 : next(property.count_type);
            if (!length || !(*length >= 0.0)) return std::nullopt;
            constexpr double max_count = 1e18;  // more than any file has
            const auto count = static_cast<std::uint64_t>(std::min(*length, max_count));
            for (std::uint64_t i = 0; i < count; ++i) {
                const auto number = next(property.type.value_or(property.item_type));
                if (!number) return std::nullopt;
                if (&property == &wanted) numbers.push_back(*number);
            }
        }
        return numbers;
    }

  private:
    std::optional<double> next(NumberType type) {
        if (is_text_) return next_word_ < row_.size() ? number_of(row_[next_word_++]) : std::nullopt;
        const std::size_t size = size_of(type);
        if (lines_.rest().size() < size) return std::nullopt;
        const auto* const place = reinterpret_cast<const std::byte*>(lines_.rest().data());
        const double number = number_at(place, type, big_endian_);
        lines_.skip(size);
        return number;
    }

    Lines& lines_;
    bool is_text_, big_endian_;
    Words row_;  // of text
    std::size_t next_word_ = 0;
};

Result<void> visit_rows(const Element& element, std::uint64_t vertices, RowReader& reader,
                        const PlyFaceVisitor& visit) {
    const auto list =
        std::find_if(element.properties.begin(), element.properties.end(), [](const Property& p) {
            return !p.type && (p.name == "vertex_indices" || p.name == "vertex_index");
        });
    const std::string name(element.name);
    if (list == element.properties.end())
        return fail("the element " + name + " has no list vertex_indices or vertex_index");
    const bool is_strip = element.name == "tristrips";
    const double least = is_strip ? -1.0 : 0.0;  // -1 begins another strip
    for (std::uint64_t i = 0; i < element.count; ++i) {
        const auto indices = reader.list(element, *list);
        if (!indices)
            return fail(name + " " + std::to_string(i) + ": expected a row of numbers; the header promises " +
                        std::to_string(element.count));
        for (const double index : *indices)
            if (!(index >= least && index < static_cast<double>(vertices)))
                return fail(name + " " + std::to_string(i) + ": expected indices of " +
                            std::to_string(vertices) + " vertices");
        visit({indices->begin(), indices->end()}, is_strip);
    }
    return {};
}

}  // namespace

bool is_ply(std::span<const std::byte> bytes) {
    const std::string_view text = text_of(bytes);
    return text.starts_with("ply\n") || text.starts_with("ply\r\n");
}

Result<std::uint64_t> ply_face_count(std::span<const std::byte> bytes) {
    Lines lines(text_of(bytes));
    const auto header = read_ply_header(lines);
    if (!header) return tl::unexpected(header.error());
    std::uint64_t count = 0;
    for (const Element& element : header->elements) {
        if (element.name == "face" || element.name == "tristrips") count += element.count;
    }
    return count;
}

Result<PlyVertices> find_ply_vertices(std::span<const std::byte> bytes) {
    Lines lines(text_of(bytes));
    const auto header = read_ply_header(lines);
    if (!header) return tl::unexpected(header.error());
    const bool is_text = header->format == "ascii";
    const bool big_endian = header->format == "binary_big_endian";
    if (!is_text && !big_endian && header->format != "binary_little_endian")
        return fail("format '" + std::string(header->format.substr(0, 40)) +
                    "'; expected ascii, binary_little_endian or binary_big_endian");
    for (const Element& element : header->elements) {
        if (element.name != "vertex") {
            if (const auto skipped = skip_rows(element, is_text, lines); !skipped)
                return tl::unexpected(skipped.error());
            continue;
        }
        const auto places = coordinates(element);
        if (!places) return tl::unexpected(places.error());
        const Columns columns = columns_of(element, *places, bytes.size() - lines.rest().size());
        Lines rows_end = lines;
        if (const auto complete = is_text ? Result<void>() : skip_rows(element, false, rows_end); !complete)
            return tl::unexpected(complete.error());
        return PlyVertices{element.count, is_text, big_endian, *places, lines, columns};
    }
    return fail("the header has no element vertex");
}

Result<std::vector<Vec3d>> read_ply_points(std::span<const std::byte> bytes) {
    Result<PlyVertices> vertices = find_ply_vertices(bytes);
    if (!vertices) return tl::unexpected(vertices.error());
    if (const auto fits = check_point_count(vertices->count); !fits) return tl::unexpected(fits.error());
    if (vertices->is_text) return read_lines(vertices->lines, vertices->places, vertices->count, blanks);
    return read_columns(bytes, vertices->columns, vertices->count, vertices->big_endian);
}

Result<void> visit_ply_faces(std::span<const std::byte> bytes, std::uint64_t vertices,
                             const PlyFaceVisitor& visit) {
    Lines lines(text_of(bytes));
    const auto header = read_ply_header(lines);
    if (!header) return tl::unexpected(header.error());
    RowReader reader(lines, header->format);
    const auto has_faces = [](const Element& element) {
        return element.name == "face" || element.name == "tristrips";
    };
    const auto last = std::find_if(header->elements.rbegin(), header->elements.rend(), has_faces).base();
    for (auto element = header->elements.begin(); element != last; ++element) {
        const auto read = has_faces(*element) ? visit_rows(*element, vertices, reader, visit)
                                              : skip_rows(*element, header->format == "ascii", lines);
        if (!read) return tl::unexpected(read.error());
    }
    return {};
}

}  // namespace camdir::scene
