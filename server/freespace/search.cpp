#include "freespace/search.hpp"

#include <algorithm>
#include <array>

#include "base/float4.hpp"
#include "freespace/index.hpp"

namespace camdir::freespace {
namespace {

struct Candidate {
    float bound = 0.0F;  // no slab below has a larger value
    IndexChild child = IndexChild::leaf(0, 0);
};
// Each level leaves at most three siblings behind.
using Stack = std::array<Candidate, 3 * index_depth_limit + 1>;

// Upper bounds of the values of the slabs below each child. A ball around the point inside one of these slabs
// has a radius of at most max_radius - |point - box|, and it lies inside the reach.
Float4 bounds_of_children(const IndexNode& node, const Vec3f& point) {
    const auto gap = [](const float* low, const float* high, Float4 c) {
        return larger(larger(load(low) - c, c - load(high)), Float4{});
    };
    const auto room = [](const float* low, const float* high, Float4 c) {
        return smaller(c - load(low), load(high) - c);
    };
    const Float4 px = broadcast(point.x());
    const Float4 py = broadcast(point.y());
    const Float4 pz = broadcast(point.z());
    const auto& [low, high] = node.box;
    const Float4 x = gap(low[0], high[0], px);
    const Float4 y = gap(low[1], high[1], py);
    const Float4 z = gap(low[2], high[2], pz);
    const Float4 by_radius = load(node.max_radius) - square_root(x * x + y * y + z * z);
    const auto& [reach_low, reach_high] = node.reach;
    const Float4 by_reach =
        smaller(smaller(room(reach_low[0], reach_high[0], px), room(reach_low[1], reach_high[1], py)),
                room(reach_low[2], reach_high[2], pz));
    return smaller(by_radius, by_reach);
}

// Pushes the children that can beat `to_beat`, the most promising last; returns the new height.
std::size_t push_children(const IndexNode& node, const Vec3f& point, float to_beat, Stack& stack,
                          std::size_t height) {
    const Float4 bounds = bounds_of_children(node, point);
    const std::size_t base = height;
    for (std::uint32_t k = 0; k < IndexNode::width; ++k) {
        if (!(bounds[k] > to_beat)) continue;
        std::size_t place = height++;
        for (; place > base && stack[place - 1].bound > bounds[k]; --place)
            stack[place] = stack[place - 1];
        stack[place] = {bounds[k], IndexChild(node.child[k])};
    }
    return height;
}

}  // namespace

// Depth first.
void improve_everywhere(const MeshView& mesh, std::span<const IndexNode> index, const Vec3f& point,
                        float slack, SlabPoint& best) {
    if (index.empty()) return;
    Stack stack;
    stack[0] = {std::numeric_limits<float>::infinity(), IndexChild::node(0)};
    std::size_t height = 1;
    while (height > 0) {
        const Candidate top = stack[--height];
        const float to_beat = best.value + slack * std::max(best.value, 0.0F);
        if (!(top.bound > to_beat)) continue;
        if (top.child.is_leaf())
            improve_range(mesh, point, top.child.first(), top.child.count(), best);
        else
            height = push_children(index[top.child.index()], point, to_beat, stack, height);
    }
}

}  // namespace camdir::freespace
