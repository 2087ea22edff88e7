#include "evaluation/csv.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <vector>

#include "evaluation/lines.hpp"

namespace camdir::evaluation {
namespace {

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> fields;
    while (true) {
        const std::size_t comma = line.find(',');
        fields.push_back(line.substr(0, comma));
        if (comma == std::string_view::npos) return fields;
        line.remove_prefix(comma + 1);
    }
}

// What the user wrote, safe to print and short.
std::string quoted(std::string_view field) {
    constexpr std::size_t longest = 40;
    std::string text = "\"";
    for (const char c : field.substr(0, longest))
        text += c >= ' ' && c <= '~' ? c : '?';
    return text + (field.size() > longest ? "...\"" : "\"");
}

std::string shown(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

// With its other name, if it has one.
std::string name_of(const TextColumn& column) {
    const std::string name = quoted(column.name);
    return std::string_view(column.name) == column.alias ? name : name + " or " + quoted(column.alias);
}

class Table {
  public:
    Table(std::span<const TextColumn> columns, const TextRowSink& sink)
        : columns_(columns), sink_(sink), values_(columns.size()) {}

    [[nodiscard]] bool has_header() const { return field_count_ != 0; }

    Result<void> read_header(std::string_view line) {
        const auto names = split(line);
        for (const TextColumn& column : columns_) {
            const auto is_it = [&](std::string_view name) {
                return name == column.name || name == column.alias;
            };
            const auto found = std::ranges::find_if(names, is_it);
            if (found == names.end() && !column.optional)
                return fail("the header lacks the column " + quoted(column.name) + "; found " + quoted(line));
            if (std::ranges::count_if(names, is_it) > 1)
                return fail("the header has the column " + name_of(column) + " more than once; found " +
                            quoted(line));
            places_.push_back(static_cast<std::size_t>(found - names.begin()));
        }
        field_count_ = names.size();
        return {};
    }

    Result<void> read_row(std::string_view line) {
        const auto fields = split(line);
        if (fields.size() != field_count_)
            return fail(std::to_string(fields.size()) + " fields, expected " + std::to_string(field_count_) +
                        " as in the header");
        for (std::size_t i = 0; i < columns_.size(); ++i)
            values_[i] = places_[i] < fields.size() ? fields[places_[i]] : std::string_view();
        return sink_(values_);
    }

  private:
    std::span<const TextColumn> columns_;
    const TextRowSink& sink_;
    std::vector<std::size_t> places_;  // of each of columns_ among the fields; behind them: missing
    std::vector<std::string_view> values_;
    std::size_t field_count_ = 0;
};

std::string_view without_byte_order_mark(std::string_view line) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    return line.starts_with(mark) ? line.substr(mark.size()) : line;
}

}  // namespace

Result<double> to_number(std::string_view field, const Column& column) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    const bool number = error == std::errc{} && end == field.data() + field.size() && !field.empty();
    if (number && value >= column.minimum && value <= column.maximum &&
        (!column.integer || value == std::trunc(value)))
        return value;
    return fail("column \"" + std::string(column.name) + "\" is " + quoted(field) + ", expected " +
                (column.integer ? "an integer" : "a number") + " from " + shown(column.minimum) + " to " +
                shown(column.maximum));
}

Result<void> read_text_csv(std::span<const std::byte> bytes, const std::string& name,
                           std::span<const TextColumn> columns, const TextRowSink& sink) {
    Table table(columns, sink);
    std::uint64_t line_number = 1;
    const auto read = for_each_line(bytes, [&](std::string_view line) {
        auto taken =
            table.has_header() ? table.read_row(line) : table.read_header(without_byte_order_mark(line));
        if (taken) ++line_number;
        return taken;
    });
    if (!read) return fail(name + ":" + std::to_string(line_number) + ": " + read.error().message);
    if (!table.has_header()) return fail(name + ": empty, expected a header line");
    return {};
}

Result<void> read_csv(std::span<const std::byte> bytes, const std::string& name,
                      std::span<const Column> columns, const RowSink& sink) {
    std::vector<TextColumn> names;
    for (const Column& column : columns)
        names.push_back({column.name, column.name});
    std::vector<double> values(columns.size());
    return read_text_csv(bytes, name, names, [&](std::span<const std::string_view> fields) -> Result<void> {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const auto value = to_number(fields[i], columns[i]);
            if (!value) return tl::unexpected(value.error());
            values[i] = *value;
        }
        return sink(values);
    });
}

}  // namespace camdir::evaluation
