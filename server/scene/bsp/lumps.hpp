// The lumps of a BSP file, of whatever version: a table of offsets and lengths, and the arrays there.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>

#include "base/error.hpp"
#include "scene/bsp/polygon.hpp"

namespace camdir::scene {

static_assert(std::endian::native == std::endian::little, "structures are copied from the file as they are");

struct LumpFormat {
    const char* name;          // for errors
    std::size_t element_size;  // bytes
};

class Lumps {
  public:
    // The table begins at byte `table` and has an entry for each of `formats`, which must outlive this;
    // `bytes` must hold all of it.
    Lumps(std::span<const std::byte> bytes, std::size_t table, std::span<const LumpFormat> formats)
        : bytes_(bytes), table_(table), formats_(formats) {}

    // Copies a lump's elements; they may be char, for text.
    template <class Container>
    [[nodiscard]] Result<void> read(std::size_t lump, Container& to) const;

    // Fails unless the lump lies inside the file.
    [[nodiscard]] Result<void> check_place(std::size_t lump) const;

    // Errors that name the lump, and the element and its byte in the file.
    [[nodiscard]] tl::unexpected<Error> bad_lump(std::size_t lump, const std::string& what) const;
    [[nodiscard]] tl::unexpected<Error> bad_element(std::size_t lump, std::size_t element,
                                                    const std::string& what) const;

  private:
    struct Place {
        std::int32_t offset, length;  // bytes
    };
    [[nodiscard]] Place place(std::size_t lump) const;

    std::span<const std::byte> bytes_;
    std::size_t table_;
    std::span<const LumpFormat> formats_;
};

[[nodiscard]] bool is_coordinate(float value);
[[nodiscard]] bool is_position(const std::array<float, 3>& position);
[[nodiscard]] bool is_plane(const std::array<float, 3>& normal, float distance);  // length 1 within 1 %

[[nodiscard]] Plane to_plane(const std::array<float, 3>& normal, float distance);  // of length 1 exactly
[[nodiscard]] Box3d to_box(const std::array<float, 3>& mins, const std::array<float, 3>& maxs);

[[nodiscard]] bool in_range(std::int32_t index, std::size_t size);
[[nodiscard]] bool in_range(std::int32_t first, std::int32_t count, std::size_t size);

template <class Container>
Result<void> Lumps::read(std::size_t lump, Container& to) const {
    using Element = typename Container::value_type;
    static_assert(std::is_trivially_copyable_v<Element>);
    if (const Result<void> inside = check_place(lump); !inside) return inside;
    const auto [offset, length] = place(lump);
    const auto size = static_cast<std::size_t>(length);
    if (size % sizeof(Element) != 0)
        return bad_lump(lump, "length " + std::to_string(length) + " is no multiple of " +
                                  std::to_string(sizeof(Element)));
    to.resize(size / sizeof(Element));
    if (length > 0) std::memcpy(to.data(), bytes_.data() + offset, size);
    return {};
}

}  // namespace camdir::scene
