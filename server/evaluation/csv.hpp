// Tables of numbers as comma-separated text, plain or gzip: what traces and camera paths are read from.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace camdir::evaluation {

inline constexpr double largest_coordinate = 1e6;  // of positions in tables, map units

struct Column {
    const char* name;
    double minimum;
    double maximum;
    bool integer = false;
};

// Receives one row: a number for each requested column, in that order. Its errors need not say where: the
// file's name and the line are put before them.
using RowSink = std::function<Result<void>(std::span<const double>)>;

// Reads the header line, which must name every one of `columns` once (others are ignored, the order is free),
// then hands each row to `sink`. Fields are plain numbers without quotes; lines may end in CR LF; the last
// line may lack its end; the first may begin with the byte order mark of UTF-8, as spreadsheets write it.
// Errors name the line, the column, what was found and what was expected.
//
// `bytes` are text, or gzip of it; the limits are those of for_each_line().
[[nodiscard]] Result<void> read_csv(std::span<const std::byte> bytes, const std::string& name,
                                    std::span<const Column> columns, const RowSink& sink);

// A column whose fields are not all numbers: its name, and another one that some files have for it instead.
// Where an optional one is missing, its fields are empty.
struct TextColumn {
    const char* name;
    const char* alias;
    bool optional = false;
};

// Receives one row as it is written: a field for each requested column.
using TextRowSink = std::function<Result<void>(std::span<const std::string_view>)>;

// As read_csv, for fields of any text without quotes.
[[nodiscard]] Result<void> read_text_csv(std::span<const std::byte> bytes, const std::string& name,
                                         std::span<const TextColumn> columns, const TextRowSink& sink);

// The number that `field` is; the error says what `column` expects.
[[nodiscard]] Result<double> to_number(std::string_view field, const Column& column);

}  // namespace camdir::evaluation
