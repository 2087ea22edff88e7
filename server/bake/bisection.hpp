// The bisection of obstacle triangles whose midpoints become samples.
#pragma once

#include <array>

#include "bake/geometry/solids.hpp"
#include "bake/geometry/triangle.hpp"
#include "bake/sampling_distance.hpp"

namespace camdir::bake {

// Largest distance from a point of the triangle to the nearest of its corners.
[[nodiscard]] double covering_radius(const Triangle3d& triangle);

// An obstacle triangle, or a part of one that bisection left, with d_s at its corners.
struct Piece {
    Triangle3d corners;
    std::array<double, 3> distances;
};

// Immutable, thread-safe. What is passed must outlive it.
class Bisection {
  public:
    // `slack` as for sample().
    Bisection(const Solids& solids, const SamplingDistance& distance, double slack)
        : solids_(solids), distance_(distance), slack_(slack) {}

    [[nodiscard]] Piece piece(const Triangle3d& triangle) const;

    // It bounds no free space and needs no samples. Gaps as narrow as rounding makes them count as closed.
    [[nodiscard]] bool is_buried(const Triangle3d& triangle) const;

    // Samples at its corners are enough.
    [[nodiscard]] bool is_fine(const Piece& piece) const;

    // Cut through the middle of the longest edge, which is corner 1 of the first half and corner 0 of the
    // second.
    [[nodiscard]] std::array<Piece, 2> halves(const Piece& piece) const;

    // A piece that is not fine would be with any d0 larger than this.
    [[nodiscard]] double fine_above_d0(const Piece& piece) const;

  private:
    const Solids& solids_;
    const SamplingDistance& distance_;
    double slack_;
};

}  // namespace camdir::bake
