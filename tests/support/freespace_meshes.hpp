// Synthetic freespaces for tests.
#pragma once

#include <random>

#include "freespace/freespace.hpp"

namespace camdir::test {

// A box as a hull of six half spaces.
[[nodiscard]] freespace::ConvexHull box_hull(const Box3f& box);

// Contents without a mesh, every field of the metadata set; a door of two boxes, and a sphere.
[[nodiscard]] freespace::Contents empty_contents();

// Two triangles over the square [0, 100] x [0, 100] at z = 0, free distance 40 at every corner.
[[nodiscard]] freespace::Contents square_contents();

// A bent sheet like a medial surface (a grid of columns x rows vertices with uneven spacing and smooth free
// distances, some of them negative) around `centre`, and loose triangles of every shape around it: slivers,
// needles, coincident corners, free distances that fall faster than the distance grows.
[[nodiscard]] freespace::Contents random_contents(std::mt19937& random, int columns, int rows, int loose,
                                                  const Vec3f& centre = Vec3f::Zero());

// A uniformly random point of the freespace's bounds, enlarged by 20 units.
[[nodiscard]] Vec3f random_point(std::mt19937& random, const freespace::Freespace& freespace);

// A random point that some slab covers.
[[nodiscard]] Vec3f covered_point(std::mt19937& random, const freespace::Freespace& freespace);

// encode and parse; a failure throws.
[[nodiscard]] freespace::Freespace make_freespace(const freespace::Contents& contents);

}  // namespace camdir::test
