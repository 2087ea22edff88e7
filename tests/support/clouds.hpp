// Point clouds and meshes made up for tests, as the bytes of files.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/geometry.hpp"

namespace camdir::test {

template <class T>
void append(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

inline Bytes bytes_of(const std::string& text) {
    const auto* first = reinterpret_cast<const std::byte*>(text.data());
    return {first, first + text.size()};
}

// Points of a regular grid on the six walls of a box, corners and edges included.
inline std::vector<Vec3d> walls_of(const Box3d& box, double spacing) {
    std::vector<Vec3d> points;
    const Eigen::Vector3i cells = (box.sizes() / spacing).array().round().matrix().cast<int>();
    for (int x = 0; x <= cells.x(); ++x)
        for (int y = 0; y <= cells.y(); ++y)
            for (int z = 0; z <= cells.z(); ++z) {
                const Eigen::Vector3i at(x, y, z);
                if ((at.array() == 0).any() || (at.array() == cells.array()).any())
                    points.push_back(box.min() + box.sizes().cwiseProduct(
                                                     at.cast<double>().cwiseQuotient(cells.cast<double>())));
            }
    return points;
}

inline std::string xyz_of(const std::vector<Vec3d>& points) {
    std::string text;
    for (const Vec3d& p : points)
        text += std::to_string(p.x()) + ' ' + std::to_string(p.y()) + ' ' + std::to_string(p.z()) + '\n';
    return text;
}

inline std::string pcd_header(std::size_t count, const std::string& data) {
    return "# .PCD v0.7\nVERSION 0.7\nFIELDS intensity x y z\nSIZE 1 4 4 4\nTYPE U F F F\nCOUNT 1 1 1 "
           "1\nWIDTH " +
           std::to_string(count) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(count) +
           "\nDATA " + data + "\n";
}

// LAS 1.2, point format 0, with a scale of 0.001.
inline std::string las_of(const std::vector<Vec3d>& points, const Vec3d& offset) {
    std::string bytes(227, '\0');
    const auto put = [&](std::size_t place, auto value) {
        std::memcpy(bytes.data() + place, &value, sizeof value);
    };
    std::memcpy(bytes.data(), "LASF", 4);
    put(24, std::uint8_t{1});
    put(25, std::uint8_t{2});
    put(94, std::uint16_t{227});
    put(96, std::uint32_t{227});
    put(105, std::uint16_t{20});
    put(107, static_cast<std::uint32_t>(points.size()));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        put(131 + 8 * axis, 0.001);
        put(155 + 8 * axis, offset[static_cast<Eigen::Index>(axis)]);
    }
    for (const Vec3d& point : points) {
        for (const double coordinate : (point - offset).eval())
            append(bytes, static_cast<std::int32_t>(std::lround(coordinate / 0.001)));
        bytes.append(8, '\0');
    }
    return bytes;
}

}  // namespace camdir::test
