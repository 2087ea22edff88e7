#include "scene/records/records.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <charconv>
#include <cstring>
#include <string>

namespace camdir::scene {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
double number_at(const std::byte* place, bool big_endian) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), place, sizeof(T));
    if (big_endian) std::reverse(bytes.begin(), bytes.end());
    T value;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return static_cast<double>(value);
}

}  // namespace

double number_at(const std::byte* place, NumberType type, bool big_endian) {
    switch (type) {
        case NumberType::int8:
            return number_at<std::int8_t>(place, big_endian);
        case NumberType::uint8:
            return number_at<std::uint8_t>(place, big_endian);
        case NumberType::int16:
            return number_at<std::int16_t>(place, big_endian);
        case NumberType::uint16:
            return number_at<std::uint16_t>(place, big_endian);
        case NumberType::int32:
            return number_at<std::int32_t>(place, big_endian);
        case NumberType::uint32:
            return number_at<std::uint32_t>(place, big_endian);
        case NumberType::int64:
            return number_at<std::int64_t>(place, big_endian);
        case NumberType::uint64:
            return number_at<std::uint64_t>(place, big_endian);
        case NumberType::float32:
            return number_at<float>(place, big_endian);
        case NumberType::float64:
            return number_at<double>(place, big_endian);
    }
    assert(false);
    return 0.0;
}

Result<void> check_point_count(std::uint64_t count) {
    if (count <= max_points) return {};
    return fail(std::to_string(count) + " points; the limit is " + std::to_string(max_points) +
                ": thin the cloud first");
}

std::size_t size_of(NumberType type) {
    constexpr std::array<std::size_t, 10> sizes = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

std::vector<Vec3d> read_columns(std::span<const std::byte> bytes, const Columns& columns, std::size_t count,
                                bool big_endian) {
    std::vector<Vec3d> points(count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto& [offset, stride, type] = columns[axis];
        assert(count == 0 || offset + (count - 1) * stride + size_of(type) <= bytes.size());
        for (std::size_t i = 0; i < count; ++i)
            points[i][static_cast<Eigen::Index>(axis)] =
                number_at(bytes.data() + offset + i * stride, type, big_endian);
    }
    return points;
}

std::optional<std::string_view> Lines::next() {
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    ++number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

tl::unexpected<Error> Lines::bad_line(const std::string& what) const {
    return fail("line " + std::to_string(number_) + ": " + what);
}

std::vector<std::string_view> words_of(std::string_view line, std::string_view separators) {
    std::vector<std::string_view> words;
    for (std::size_t i = line.find_first_not_of(separators); i < line.size();
         i = line.find_first_not_of(separators, i)) {
        const std::size_t end = std::min(line.find_first_of(separators, i), line.size());
        words.push_back(line.substr(i, end - i));
        i = end;
    }
    return words;
}

std::optional<double> number_of(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
    return number;
}

std::optional<std::uint64_t> whole_number(std::string_view word) {
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size() || number >> 63U != 0) return std::nullopt;
    return number;
}

Result<std::vector<Vec3d>> read_lines(Lines& lines, const std::array<std::size_t, 3>& places,
                                      std::optional<std::uint64_t> count, std::string_view separators) {
    const std::size_t needed = *std::max_element(places.begin(), places.end()) + 1;
    std::vector<Vec3d> points;
    while (!count || points.size() < *count) {
        const auto line = lines.next();
        if (!line) break;
        const std::vector<std::string_view> words = words_of(*line, separators);
        if (words.empty() || words.front().starts_with('#')) continue;
        if (words.size() < needed)
            return lines.bad_line(std::to_string(words.size()) + " numbers; expected at least " +
                                  std::to_string(needed));
        Vec3d point;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string_view word = words[places[axis]];
            const std::optional<double> number = number_of(word);
            if (!number)
                return lines.bad_line("'" + std::string(word.substr(0, 40)) + "'; expected a number");
            point[static_cast<Eigen::Index>(axis)] = *number;
        }
        points.push_back(point);
        if (points.size() > max_points) break;
    }
    if (const auto fits = check_point_count(points.size()); !fits) return tl::unexpected(fits.error());
    if (count && points.size() < *count)
        return fail("ends after " + std::to_string(points.size()) + " points; the header promises " +
                    std::to_string(*count));
    return points;
}

std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace camdir::scene
