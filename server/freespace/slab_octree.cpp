#include "freespace/slab_octree.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <limits>

namespace camdir::freespace {

SlabOctree::Node SlabOctree::leaf_at(const Vec3f& point) const {
    std::array<std::uint32_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis) {
        const float position = (point[axis] - origin_[axis]) * cells_per_unit_;
        const std::uint32_t count = extent_[static_cast<std::size_t>(axis)];
        if (!(position >= 0.0F && position < static_cast<float>(count))) return empty_leaf;
        cell[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(position);
    }
    int shift = grid_shift_;
    const std::size_t columns = extent_[0] >> shift;
    const std::size_t rows = extent_[1] >> shift;
    Node node = grid_[((cell[2] >> shift) * rows + (cell[1] >> shift)) * columns + (cell[0] >> shift)];
    while ((node & leaf_bit) == 0) {
        --shift;
        node = nodes_[node + ((cell[0] >> shift & 1U) | (cell[1] >> shift & 1U) << 1U |
                              (cell[2] >> shift & 1U) << 2U)];
    }
    return node;
}

namespace {

// So many bounds are kept between the two passes over a list.
constexpr std::uint32_t chunk_quads = 64 / lane_count;

// The best of the slabs that were evaluated, one a lane.
struct BestOfLanes {
    Float4 value;
    Float4 u{}, v{};
    Mask4 slab = {-1, -1, -1, -1};

    void improve(std::span<const SlabFrame> frames, const FourSlabs& slabs, const Vec3f& point) {
        const SlabPoints points = slab_points(frames, slabs, point);
        Mask4 candidates;
        std::memcpy(&candidates, slabs, sizeof candidates);
        const Mask4 better = points.value > value;
        value = better ? points.value : value;
        u = better ? points.u : u;
        v = better ? points.v : v;
        slab = better ? candidates : slab;
    }
    [[nodiscard]] SlabPoint point() const {
        const int k = std::countr_zero(bits(value == broadcast(largest(value))));
        return {value[k], static_cast<std::uint32_t>(slab[k]), u[k], v[k]};
    }
};

}  // namespace

SlabPoint SlabOctree::best(const Vec3f& point, float least) const {
    const Node leaf = leaf_at(point);
    if (leaf == empty_leaf) return uncovered;
    const std::byte* list = &lists_[std::size_t{leaf & ~leaf_bit} * list_unit];
    ListHead head;
    std::memcpy(&head, list, sizeof head);
    const std::byte* quads = list + sizeof head;
    const Vec3f way = (point - Vec3f(head.centre)) / slope_unit;
    const float drop = drop_unit * head.half;
    const float top = head.top - 128.0F * drop;
    const auto bounds_of = [&](const std::byte* quad) {
        Float4 terms[4];
        convert(quad + offsetof(Quad, bounds), terms);
        return top - drop * terms[0] + (way.x() * terms[1] + way.y() * terms[2] + way.z() * terms[3]);
    };
    const auto slabs_of = [](const std::byte* quad) {
        Mask4 slabs;
        std::memcpy(&slabs, quad + offsetof(Quad, slabs), sizeof slabs);
        return slabs;
    };
    const auto slab_of = [](const std::byte* first, int number) {
        std::uint32_t slab;
        const auto at = static_cast<std::size_t>(number);
        std::memcpy(
            &slab,
            first + at / lane_count * sizeof(Quad) + offsetof(Quad, slabs) + at % lane_count * sizeof slab,
            sizeof slab);
        return slab;
    };

    BestOfLanes best{.value = broadcast(least)};
    for (std::uint32_t remaining = head.quads; remaining > 0;) {
        const std::uint32_t count = std::min(remaining, chunk_quads);
        // First the most promising slab of each lane, then what may be better still.
        Float4 bounds[chunk_quads];
        Float4 highest = broadcast(-std::numeric_limits<float>::infinity());
        Mask4 first{};
        for (std::uint32_t i = 0; i < count; ++i) {
            bounds[i] = bounds_of(quads + i * sizeof(Quad));
            const Mask4 slabs = slabs_of(quads + i * sizeof(Quad));
            const Mask4 higher = bounds[i] > highest;
            highest = higher ? bounds[i] : highest;
            first = higher ? slabs : first;
        }
        FourSlabs four;
        std::memcpy(four, &first, sizeof four);
        if (largest(highest) > largest(best.value)) best.improve(frames_.frames, four, point);
        const Float4 to_beat = broadcast(largest(best.value));
        std::uint64_t promising = 0;  // a bit for each slab of the chunk
        for (std::uint32_t i = 0; i < count; ++i) {
            const Mask4 slabs = slabs_of(quads + i * sizeof(Quad));
            const std::uint64_t chosen = bits((bounds[i] > to_beat) & (slabs != first));
            promising |= chosen << lane_count * i;
        }
        while (promising != 0) {
            std::uint32_t slab = 0;
            for (std::uint32_t& each : four) {
                if (promising != 0) slab = slab_of(quads, std::countr_zero(promising));
                promising &= promising - 1;
                each = slab;
            }
            best.improve(frames_.frames, four, point);
        }
        quads += count * sizeof(Quad);
        remaining -= count;
    }
    return best.point();
}

Ball SlabOctree::ball(const SlabPoint& point) const {
    return ball_at(vertices_, frames_.corners[point.triangle], point);
}

std::size_t SlabOctree::memory() const {
    return frames_.frames.capacity() * sizeof(SlabFrame) + frames_.corners.capacity() * sizeof(Triangle) +
           (grid_.capacity() + nodes_.capacity()) * sizeof(Node) + lists_.capacity();
}

}  // namespace camdir::freespace
