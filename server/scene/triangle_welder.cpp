#include "scene/triangle_welder.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::scene {
namespace {

// The finaliser of a 64-bit mixing hash (odd constant, high bits folded down), chained over three numbers.
std::size_t mix(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
    std::uint64_t hash = 0;
    for (const std::uint64_t part : {a, b, c}) {
        hash = (hash ^ part) * 0x9e3779b97f4a7c15U;
        hash ^= hash >> 32U;
    }
    return hash;
}

}  // namespace

std::size_t TriangleWelder::Hash::operator()(const Cell& cell) const {
    return mix(static_cast<std::uint64_t>(cell[0]), static_cast<std::uint64_t>(cell[1]),
               static_cast<std::uint64_t>(cell[2]));
}

std::size_t TriangleWelder::Hash::operator()(const Corners& corners) const {
    return mix(corners[0], corners[1], corners[2]);
}

bool TriangleWelder::add(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Corners corners = {vertex_at(a), vertex_at(b), vertex_at(c)};
    if (is_flat(corners)) return false;
    Corners ascending = corners;
    std::sort(ascending.begin(), ascending.end());
    if (!known_triangles_.insert(ascending).second) return false;
    triangles_.push_back(corners);
    return true;
}

std::uint32_t TriangleWelder::vertex_at(const Vec3d& point) {
    const auto cell_of = [&](Eigen::Index axis) {
        return static_cast<std::int64_t>(std::floor(point[axis] / tolerance_));
    };
    const Cell home = {cell_of(0), cell_of(1), cell_of(2)};
    auto found = static_cast<std::uint32_t>(vertices_.size());
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
        for (std::int64_t dy = -1; dy <= 1; ++dy) {
            for (std::int64_t dz = -1; dz <= 1; ++dz) {
                const auto range = vertices_of_cell_.equal_range({home[0] + dx, home[1] + dy, home[2] + dz});
                for (auto it = range.first; it != range.second; ++it) {
                    if ((vertices_[it->second] - point).norm() <= tolerance_)
                        found = std::min(found, it->second);
                }
            }
        }
    }
    if (found == vertices_.size()) {
        vertices_.push_back(point);
        vertices_of_cell_.emplace(home, found);
    }
    return found;
}

bool TriangleWelder::is_flat(const Corners& corners) const {
    const Vec3d& a = vertices_[corners[0]];
    const Vec3d& b = vertices_[corners[1]];
    const Vec3d& c = vertices_[corners[2]];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const double twice_area = (b - a).cross(c - a).norm();
    return twice_area <= longest * tolerance_ / 100.0;
}

}  // namespace camdir::scene
