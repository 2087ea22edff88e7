// The slow, obvious twins of the queries of server/freespace: every slab, every time, in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::test {

// The largest d_f(m) - |point - m| over the points m of one triangle, to 1e-7 of the lengths involved.
[[nodiscard]] double slab_distance(const freespace::Freespace& freespace, std::uint32_t triangle,
                                   const Vec3f& point);

// The largest over all triangles; -infinity without triangles.
[[nodiscard]] double exact_distance(const freespace::Freespace& freespace, const Vec3d& point);

// The smallest exact_distance over points of the segment that are at most `step` apart, both ends included.
[[nodiscard]] double sampled_clearance(const freespace::Freespace& freespace, const Vec3d& from,
                                       const Vec3d& to, double step);

// How far along a segment the exact_distance exceeds radius + `room` everywhere; the segment's length if to
// its end. Walks by the exact distance, which changes by no more than the way.
[[nodiscard]] double exact_free_length(const freespace::Freespace& freespace, const Vec3d& from,
                                       const Vec3d& to, double radius, double room);

// Length of the shortest path over the roadmap between vertices, by Dijkstra's algorithm in its simplest
// form. starts[i] is entered at cost[i]. Infinity: not reached.
[[nodiscard]] std::vector<double> roadmap_distances(const freespace::Freespace& freespace,
                                                    const std::vector<std::uint32_t>& starts,
                                                    const std::vector<double>& costs);

}  // namespace camdir::test
