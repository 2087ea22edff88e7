// Spatial hashing: points found by the cell of a grid that they lie in.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/geometry.hpp"

namespace camdir {

// Hash of three integers: a multiplicative mix (odd constant, high bits folded down), chained.
struct TripleHash {
    template <class Triple>
    std::size_t operator()(const Triple& triple) const {
        std::uint64_t hash = 0;
        for (const auto part : triple) {
            hash = (hash ^ static_cast<std::uint64_t>(part)) * 0x9e3779b97f4a7c15U;
            hash ^= hash >> 32U;
        }
        return hash;
    }
};

// Points with numbers in the order in which they were added. What lies within `pitch` / 2 of a point lies in
// at most 8 cells.
class PointGrid {
  public:
    // `pitch`: side of a cell, > 0.
    explicit PointGrid(double pitch) : pitch_(pitch) {}

    [[nodiscard]] const std::vector<Vec3d>& points() const { return points_; }

    // Moves the points out; the grid must not be used afterwards.
    [[nodiscard]] std::vector<Vec3d> take_points() && { return std::move(points_); }

    // Returns the point's number.
    std::uint32_t add(const Vec3d& point) {
        const auto number = static_cast<std::uint32_t>(points_.size());
        const auto [entry, is_new] = last_in_cell_.try_emplace(cell_of(point), number);
        previous_.push_back(is_new ? end : entry->second);
        entry->second = number;
        points_.push_back(point);
        return number;
    }

    // The smallest number of a point within `distance` of `point`, or points().size().
    [[nodiscard]] std::uint32_t first_within(const Vec3d& point, double distance) const {
        const Cell low = cell_of(point - Vec3d::Constant(distance));
        const Cell high = cell_of(point + Vec3d::Constant(distance));
        auto first = static_cast<std::uint32_t>(points_.size());
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto found = last_in_cell_.find({x, y, z});
                    if (found == last_in_cell_.end()) continue;
                    for (std::uint32_t i = found->second; i != end; i = previous_[i])
                        if (i < first && (points_[i] - point).squaredNorm() <= distance * distance) first = i;
                }
        return first;
    }

  private:
    using Cell = std::array<std::int64_t, 3>;
    static constexpr std::uint32_t end = 0xffffffffU;

    [[nodiscard]] Cell cell_of(const Vec3d& point) const {
        const Vec3d cell = point / pitch_;
        return {static_cast<std::int64_t>(std::floor(cell.x())),
                static_cast<std::int64_t>(std::floor(cell.y())),
                static_cast<std::int64_t>(std::floor(cell.z()))};
    }

    double pitch_;
    std::vector<Vec3d> points_;
    std::unordered_map<Cell, std::uint32_t, TripleHash> last_in_cell_;
    std::vector<std::uint32_t> previous_;  // of each point: the one before it in its cell, or `end`
};

}  // namespace camdir
