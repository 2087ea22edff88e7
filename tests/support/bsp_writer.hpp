// Writes BSP files: a header, the table of lumps, the lumps.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "base/file.hpp"
#include "base/geometry.hpp"

namespace camdir::test {

inline constexpr double wall = 16.0;  // thickness, map units

[[nodiscard]] inline std::array<float, 3> floats(const Vec3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

class BspWriter {
  public:
    // `magic` is what stands before the table.
    BspWriter(std::string_view magic, std::size_t lump_count)
        : table_(magic.size()), bytes_(magic.size() + 8 * lump_count) {
        std::memcpy(bytes_.data(), magic.data(), magic.size());
    }

    template <class Container>
    void lump(std::size_t number, const Container& elements) {
        const auto content = std::as_bytes(std::span(elements));
        const std::array<std::int32_t, 2> place = {static_cast<std::int32_t>(bytes_.size()),
                                                   static_cast<std::int32_t>(content.size())};
        std::memcpy(bytes_.data() + table_ + 8 * number, place.data(), sizeof place);
        bytes_.insert(bytes_.end(), content.begin(), content.end());
        while (bytes_.size() % 4 != 0) {
            bytes_.push_back(std::byte{0});
        }
    }

    [[nodiscard]] Bytes take() { return std::move(bytes_); }

  private:
    std::size_t table_;
    Bytes bytes_;
};

}  // namespace camdir::test
