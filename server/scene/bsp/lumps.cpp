#include "scene/bsp/lumps.hpp"

#include <cmath>

#include "scene/bsp/entities.hpp"

namespace camdir::scene {

Lumps::Place Lumps::place(std::size_t lump) const {
    Place place{};
    std::memcpy(&place, bytes_.data() + table_ + sizeof place * lump, sizeof place);
    return place;
}

Result<void> Lumps::check_place(std::size_t lump) const {
    const auto [offset, length] = place(lump);
    if (offset < 0 || length < 0 || static_cast<std::size_t>(offset) > bytes_.size() ||
        static_cast<std::size_t>(length) > bytes_.size() - static_cast<std::size_t>(offset))
        return bad_lump(lump, "bytes " + std::to_string(offset) + " to " +
                                  std::to_string(std::int64_t{offset} + length) + " are not in the file of " +
                                  std::to_string(bytes_.size()) + " bytes");
    return {};
}

tl::unexpected<Error> Lumps::bad_lump(std::size_t lump, const std::string& what) const {
    return fail("lump " + std::to_string(lump) + " (" + formats_[lump].name + "): " + what);
}

tl::unexpected<Error> Lumps::bad_element(std::size_t lump, std::size_t element,
                                         const std::string& what) const {
    const std::size_t byte =
        static_cast<std::size_t>(place(lump).offset) + element * formats_[lump].element_size;
    return bad_lump(lump,
                    "element " + std::to_string(element) + " at byte " + std::to_string(byte) + ": " + what);
}

bool is_coordinate(float value) {
    return std::abs(value) < max_coordinate;  // false for NaN
}

bool is_position(const std::array<float, 3>& position) {
    return is_coordinate(position[0]) && is_coordinate(position[1]) && is_coordinate(position[2]);
}

bool is_plane(const std::array<float, 3>& normal, float distance) {
    const auto& n = normal;
    const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return std::abs(length - 1.0F) < 0.01F && is_coordinate(distance);
}

Plane to_plane(const std::array<float, 3>& normal, float distance) {
    return normalized({Vec3d(normal[0], normal[1], normal[2]), distance});
}

Box3d to_box(const std::array<float, 3>& mins, const std::array<float, 3>& maxs) {
    Box3d box;
    box.extend(Vec3d(mins[0], mins[1], mins[2]));
    box.extend(Vec3d(maxs[0], maxs[1], maxs[2]));
    return box;
}

bool in_range(std::int32_t index, std::size_t size) {
    return index >= 0 && static_cast<std::size_t>(index) < size;
}

bool in_range(std::int32_t first, std::int32_t count, std::size_t size) {
    return first >= 0 && count >= 0 && std::int64_t{first} + count <= static_cast<std::int64_t>(size);
}

}  // namespace camdir::scene
