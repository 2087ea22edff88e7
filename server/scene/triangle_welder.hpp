// Joins corners that coincide, so that surfaces which touch share vertices.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::scene {

// Collects triangles given by their corners. A corner takes the place of the first one seen within
// `tolerance` of it. Triangles that are thereby flat (a corner less than a hundredth of the tolerance from
// the opposite side) or that are there already are dropped. The result depends on the order of the calls.
class TriangleWelder {
  public:
    explicit TriangleWelder(double tolerance) : tolerance_(tolerance) {}

    // True when the triangle was kept.
    bool add(const Vec3d& a, const Vec3d& b, const Vec3d& c);

    [[nodiscard]] std::vector<Vec3d> take_vertices() { return std::move(vertices_); }
    [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> take_triangles() { return std::move(triangles_); }

  private:
    using Cell = std::array<std::int64_t, 3>;
    using Corners = std::array<std::uint32_t, 3>;
    struct Hash {
        std::size_t operator()(const Cell& cell) const;
        std::size_t operator()(const Corners& corners) const;
    };

    [[nodiscard]] std::uint32_t vertex_at(const Vec3d& point);
    [[nodiscard]] bool is_flat(const Corners& corners) const;

    double tolerance_;
    std::vector<Vec3d> vertices_;
    std::vector<Corners> triangles_;
    std::unordered_multimap<Cell, std::uint32_t, Hash> vertices_of_cell_;
    std::unordered_set<Corners, Hash> known_triangles_;  // corners ascending
};

}  // namespace camdir::scene
