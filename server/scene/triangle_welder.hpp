// Joins corners that coincide, so that surfaces which touch share vertices.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/geometry.hpp"
#include "base/point_grid.hpp"

namespace camdir::scene {

// Of every map, nominal units.
inline constexpr double weld_tolerance = 0.01;
// The world's box fits the geometry exactly; this leaves room for rounding.
inline constexpr double box_margin = 1.0;

// Collects triangles given by their corners. A corner becomes the first vertex within `tolerance` of it, or
// a new one. Triangles that are flat afterwards (a corner less than a hundredth of the tolerance from the
// opposite side) and repeated ones are dropped. The result depends on the order of the calls.
class TriangleWelder {
  public:
    explicit TriangleWelder(double tolerance) : tolerance_(tolerance), vertices_(2.0 * tolerance) {}

    // True when the triangle was kept.
    bool add(const Vec3d& a, const Vec3d& b, const Vec3d& c);

    [[nodiscard]] std::vector<Vec3d> take_vertices() { return std::move(vertices_).take_points(); }
    [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> take_triangles() { return std::move(triangles_); }

  private:
    using Corners = std::array<std::uint32_t, 3>;

    [[nodiscard]] std::uint32_t vertex_at(const Vec3d& point);
    [[nodiscard]] bool is_flat(const Corners& corners) const;

    double tolerance_;
    PointGrid vertices_;
    std::vector<Corners> triangles_;
    std::unordered_set<Corners, TripleHash> known_triangles_;  // corners ascending
};

}  // namespace camdir::scene
