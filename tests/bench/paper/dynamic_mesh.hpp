// A triangle mesh during its reduction.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::paper {

using Corners = std::array<std::uint32_t, 3>;

// The positions stay as given; free distances change in the caller's vector. Both must outlive the mesh.
class DynamicMesh {
  public:
    DynamicMesh(const std::vector<Vec3f>& positions, std::vector<float>& free_distance,
                const std::vector<Corners>& triangles);

    [[nodiscard]] std::size_t vertex_count() const { return stars_.size(); }
    [[nodiscard]] const std::vector<std::uint32_t>& star(std::uint32_t vertex) const {
        return stars_[vertex];
    }
    [[nodiscard]] const Corners& corners(std::uint32_t triangle) const { return triangles_[triangle]; }
    [[nodiscard]] Vec3d position(std::uint32_t vertex) const { return positions_[vertex].cast<double>(); }
    [[nodiscard]] double free_distance(std::uint32_t vertex) const { return free_distance_[vertex]; }
    [[nodiscard]] bool is_edge(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] bool is_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    [[nodiscard]] double area(const Corners& corners) const;
    // The remaining triangles, in the order in which they were added.
    [[nodiscard]] std::vector<Corners> triangles() const;

    void remove_star(std::uint32_t vertex);
    void add(const Corners& corners);
    void set_free_distance(std::uint32_t vertex, float value) { free_distance_[vertex] = value; }

  private:
    const std::vector<Vec3f>& positions_;
    std::vector<float>& free_distance_;
    std::vector<Corners> triangles_;
    std::vector<char> gone_;
    std::vector<std::vector<std::uint32_t>> stars_;
};

}  // namespace camdir::paper
