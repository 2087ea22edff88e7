// The best points of slabs (slab.hpp), four at a time.
#pragma once

#include <span>

#include "base/float4.hpp"
#include "freespace/slab_frame.hpp"

namespace camdir::freespace {

// Indices of four frames that are computed side by side.
using FourSlabs = std::uint32_t[lane_count];

// The best points m of four slabs: r(m) - |point - m|, rounded; m = a + u (b - a) + v (c - a); m - point.
struct SlabPoints {
    Float4 value, u, v;
    Float4 way_x, way_y, way_z;
};

namespace kernel {

struct Rows {
    Float4 origin_x, origin_y, origin_z, radius_a;
    Float4 along_x, along_y, along_z, length;
    Float4 normal_x, normal_y, normal_z, c_x;
    Float4 c_y, gradient_x, gradient_y, fall;
    Float4 inverse_fall, uphill_ab, uphill_ac, uphill_bc;
    Float4 rise_ac, rise_bc, inverse_ac2, inverse_bc2;
};
static_assert(sizeof(Rows) == lane_count * sizeof(SlabFrame));

inline Rows gather(const SlabFrame* frames, const FourSlabs& slabs) {
    const float* const from[lane_count] = {frames[slabs[0]].origin, frames[slabs[1]].origin,
                                           frames[slabs[2]].origin, frames[slabs[3]].origin};
    const auto row = [&](int first, Float4& a, Float4& b, Float4& c, Float4& d) {
        a = load(from[0] + first);
        b = load(from[1] + first);
        c = load(from[2] + first);
        d = load(from[3] + first);
        transpose(a, b, c, d);
    };
    Rows r;
    row(0, r.origin_x, r.origin_y, r.origin_z, r.radius_a);
    row(4, r.along_x, r.along_y, r.along_z, r.length);
    row(8, r.normal_x, r.normal_y, r.normal_z, r.c_x);
    row(12, r.c_y, r.gradient_x, r.gradient_y, r.fall);
    row(16, r.inverse_fall, r.uphill_ab, r.uphill_ac, r.uphill_bc);
    row(20, r.rise_ac, r.rise_bc, r.inverse_ac2, r.inverse_bc2);
    return r;
}

inline Rows spread(const SlabFrame& f) {
    const auto all = [](float value) { return broadcast(value); };
    return {all(f.origin[0]), all(f.origin[1]),    all(f.origin[2]),   all(f.radius_a),   all(f.along[0]),
            all(f.along[1]),  all(f.along[2]),     all(f.length),      all(f.normal[0]),  all(f.normal[1]),
            all(f.normal[2]), all(f.c_x),          all(f.c_y),         all(f.gradient_x), all(f.gradient_y),
            all(f.fall),      all(f.inverse_fall), all(f.uphill_ab),   all(f.uphill_ac),  all(f.uphill_bc),
            all(f.rise_ac),   all(f.rise_bc),      all(f.inverse_ac2), all(f.inverse_bc2)};
}

struct FrameEdgePoints {
    Float4 value, t;
};

// `foot`: the share of the edge at which the point's foot lies; `gap2`: its squared distance from the edge's
// line; `length2`: squared length of the edge.
inline FrameEdgePoints best_on_edge(Float4 foot, Float4 gap2, Float4 end, Float4 uphill, Float4 radius,
                                    Float4 rise, Float4 length2) {
    const Float4 t = smaller(larger(foot + uphill * square_root(gap2), Float4{}), end);
    const Float4 beside = t - foot;
    return {radius + t * rise - square_root(beside * beside * length2 + gap2), t};
}

// Without `with_points`, values alone.
template <bool with_points>
inline SlabPoints best_points(const Rows& r, Float4 px, Float4 py, Float4 pz) {
    const Float4 zero{};
    const Float4 one = zero + 1.0F;
    // The point in the frames.
    const Float4 dx = px - r.origin_x;
    const Float4 dy = py - r.origin_y;
    const Float4 dz = pz - r.origin_z;
    const Float4 side_x = r.normal_y * r.along_z - r.normal_z * r.along_y;
    const Float4 side_y = r.normal_z * r.along_x - r.normal_x * r.along_z;
    const Float4 side_z = r.normal_x * r.along_y - r.normal_y * r.along_x;
    const Float4 x = dx * r.along_x + dy * r.along_y + dz * r.along_z;
    const Float4 y = dx * side_x + dy * side_y + dz * side_z;
    const Float4 h = dx * r.normal_x + dy * r.normal_y + dz * r.normal_z;
    // Never 0, so that a steep edge is climbed from a point on it too.
    const Float4 h2 = h * h + 1e-36F;

    // Edge ab, in map units.
    const auto on_ab = best_on_edge(x, y * y + h2, r.length, r.uphill_ab, r.radius_a, r.gradient_x, one);
    SlabPoints best;
    best.value = on_ab.value;
    const auto share = [](Float4 part, Float4 whole) { return whole > 0.0F ? part / whole : Float4{}; };
    if constexpr (with_points) best.u = share(on_ab.t, r.length);
    if constexpr (with_points) best.v = zero;
    const auto keep = [&](Mask4 better, Float4 u, Float4 v) {
        best.u = better ? u : best.u;
        best.v = better ? v : best.v;
    };
    // Edges ac and bc. The larger of NaN and a value is the value.
    const auto try_edge = [&](Float4 from_u, Float4 from_x, Float4 rise, Float4 radius, Float4 uphill,
                              Float4 inverse2) {
        const Float4 span_x = r.c_x - from_x;
        const Float4 at_x = x - from_x;
        const Float4 across = at_x * r.c_y - y * span_x;
        const auto on_edge =
            best_on_edge((at_x * span_x + y * r.c_y) * inverse2, across * across * inverse2 + h2, one, uphill,
                         radius, rise, span_x * span_x + r.c_y * r.c_y);
        if constexpr (with_points) keep(on_edge.value > best.value, from_u * (1.0F - on_edge.t), on_edge.t);
        best.value = larger(on_edge.value, best.value);
    };
    try_edge(zero, zero, r.rise_ac, r.radius_a, r.uphill_ac, r.inverse_ac2);
    try_edge(one, r.length, r.rise_bc, r.radius_a + r.length * r.gradient_x, r.uphill_bc, r.inverse_bc2);

    // The interior: uphill of the foot by the height times the slope.
    const Float4 height = square_root(h2);
    const Float4 uphill = height * r.inverse_fall;
    const Float4 at_x = x + uphill * r.gradient_x;
    const Float4 at_y = y + uphill * r.gradient_y;
    const Mask4 inside = (at_y >= zero) & (at_x * r.c_y >= at_y * r.c_x) &
                         ((r.length - at_x) * r.c_y >= at_y * (r.length - r.c_x));
    const Float4 value = r.radius_a + x * r.gradient_x + y * r.gradient_y - height * r.fall;
    const Mask4 better = inside & (value > best.value);
    best.value = better ? value : best.value;

    if constexpr (with_points) {
        const Float4 inside_v = share(at_y, r.c_y);
        keep(better, share(at_x - inside_v * r.c_x, r.length), inside_v);
        const Float4 to_x = best.u * r.length + best.v * r.c_x - x;
        const Float4 to_y = best.v * r.c_y - y;
        best.way_x = to_x * r.along_x + to_y * side_x - h * r.normal_x;
        best.way_y = to_x * r.along_y + to_y * side_y - h * r.normal_y;
        best.way_z = to_x * r.along_z + to_y * side_z - h * r.normal_z;
    }
    return best;
}

}  // namespace kernel

// The values of one slab at four points.
inline Float4 slab_values(const SlabFrame& frame, Float4 x, Float4 y, Float4 z) {
    return kernel::best_points<false>(kernel::spread(frame), x, y, z).value;
}

// The values of four slabs at one point.
inline Float4 slab_values(std::span<const SlabFrame> frames, const FourSlabs& slabs, const Vec3f& point) {
    return kernel::best_points<false>(kernel::gather(frames.data(), slabs), broadcast(point.x()),
                                      broadcast(point.y()), broadcast(point.z()))
        .value;
}

// The best points of four slabs for one point.
inline SlabPoints slab_points(std::span<const SlabFrame> frames, const FourSlabs& slabs, const Vec3f& point) {
    return kernel::best_points<true>(kernel::gather(frames.data(), slabs), broadcast(point.x()),
                                     broadcast(point.y()), broadcast(point.z()));
}

}  // namespace camdir::freespace
