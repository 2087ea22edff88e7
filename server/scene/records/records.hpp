// Text and binary records of numbers: what the formats of meshes and point clouds share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/geometry.hpp"

namespace camdir::scene {

// More points are refused: baking them takes several GB.
inline constexpr std::uint64_t max_points = 20'000'000;

[[nodiscard]] Result<void> check_point_count(std::uint64_t count);

enum class NumberType { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
[[nodiscard]] std::size_t size_of(NumberType type);

// Where the numbers of one coordinate lie: the i-th at byte offset + i * stride.
struct Column {
    std::size_t offset;
    std::size_t stride;
    NumberType type;
};
using Columns = std::array<Column, 3>;  // x, y, z

// Reads the bytes of one number.
[[nodiscard]] double number_at(const std::byte* place, NumberType type, bool big_endian);

// Precondition: all numbers lie in `bytes`.
[[nodiscard]] std::vector<Vec3d> read_columns(std::span<const std::byte> bytes, const Columns& columns,
                                              std::size_t count, bool big_endian = false);

// The header of a format in lines. Views into the text.
class Lines {
  public:
    explicit Lines(std::string_view text) : rest_(text) {}

    // Without the line's end (\n or \r\n); nothing at the end of the text.
    [[nodiscard]] std::optional<std::string_view> next();
    [[nodiscard]] std::size_t number() const { return number_; }  // of the line last given, from 1
    [[nodiscard]] std::string_view rest() const { return rest_; }
    void skip(std::size_t bytes) { rest_.remove_prefix(bytes); }  // at most the rest
    [[nodiscard]] tl::unexpected<Error> bad_line(const std::string& what) const;

  private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

inline constexpr std::string_view blanks = " \t\r";
inline constexpr std::string_view blanks_and_commas = " \t\r,;";

[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line,
                                                     std::string_view separators = blanks_and_commas);
// The whole word is a number; NaN and infinity are numbers.
[[nodiscard]] std::optional<double> number_of(std::string_view word);
// The whole word is a number below 2^63.
[[nodiscard]] std::optional<std::uint64_t> whole_number(std::string_view word);

// A position a line in words x, y, z (their places in the line); NaN is a number. Blank lines and lines that
// start with # are skipped. With `count`: exactly that many; fails when there are fewer.
[[nodiscard]] Result<std::vector<Vec3d>> read_lines(Lines& lines, const std::array<std::size_t, 3>& places,
                                                    std::optional<std::uint64_t> count,
                                                    std::string_view separators = blanks_and_commas);

[[nodiscard]] std::string_view text_of(std::span<const std::byte> bytes);

}  // namespace camdir::scene
