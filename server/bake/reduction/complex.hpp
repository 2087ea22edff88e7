// The medial mesh during its reduction: a complex of triangles, edges and vertices, not a manifold, in which
// a vertex can be merged into a neighbour.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "bake/medial_mesh.hpp"

namespace camdir::bake {

// Collapses that touch disjoint sets of vertices (those of all triangles at both ends) may run in parallel.
class Complex {
  public:
    using Corners = std::array<std::uint32_t, 3>;

    explicit Complex(const MedialMesh& mesh);

    [[nodiscard]] std::span<const std::uint32_t> star(std::uint32_t vertex) const { return stars_[vertex]; }
    [[nodiscard]] const Corners& corners(std::uint32_t triangle) const { return triangles_[triangle]; }
    [[nodiscard]] bool contains(std::uint32_t triangle, std::uint32_t vertex) const;
    // Vertices that share a triangle with `vertex`, ascending; replaces the contents of `neighbours`.
    void neighbours(std::uint32_t vertex, std::vector<std::uint32_t>& neighbours) const;

    // Merging `from` into `to` keeps the homotopy type of the complex, thus its components, holes and
    // cavities (link condition: the links of both ends meet in the link of their edge; Attali, Lieutier and
    // Salinas 2011), and leaves no edge without a triangle. Branches may go: a fin can shrink onto the curve
    // where it is attached. The two must be neighbours.
    [[nodiscard]] bool can_collapse(std::uint32_t from, std::uint32_t to) const;

    // Triangles of both ends vanish, the others at `from` move their corner to `to`.
    void collapse(std::uint32_t from, std::uint32_t to);

    [[nodiscard]] std::size_t triangle_count() const;
    // The remaining triangles, over the vertices of the mesh that it was made from.
    [[nodiscard]] std::vector<freespace::Triangle> triangles() const;

  private:
    // The third corner.
    [[nodiscard]] std::uint32_t opposite(std::uint32_t triangle, std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] std::size_t triangles_at_edge(std::uint32_t a, std::uint32_t b) const;
    [[nodiscard]] bool is_edge(std::uint32_t a, std::uint32_t b) const;

    std::vector<Corners> triangles_;
    std::vector<char> gone_;
    std::vector<std::vector<std::uint32_t>> stars_;
};

}  // namespace camdir::bake
