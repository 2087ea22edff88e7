// A bounding volume hierarchy over boxes, built once: the spatial index of Obstacles, Solids and
// SamplingDistance.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::bake {

// Immutable after construction; visits are thread-safe and do not allocate.
class BoxTree {
  public:
    explicit BoxTree(std::span<const Box3d> boxes);

    // Order of the items in the tree: visits report positions in it. Items stored in this order are read
    // sequentially.
    [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

    // Branch and bound, smallest key first. `key(box)`, a lower bound for all that is in the box, orders and
    // prunes: boxes whose key is >= limit() at the time of the visit are skipped. `visit(position)` handles
    // an item and may lower what limit() returns.
    template <class Key, class Limit, class Visit>
    void visit_by(const Key& key, const Limit& limit, const Visit& visit) const;

    // Visits every item whose leaf's box, and all boxes around that, satisfy `matters`.
    template <class Matters, class Visit>
    void visit_where(const Matters& matters, const Visit& visit) const;

  private:
    // A leaf when count > 0: items order_[first .. first + count). Otherwise children at first, first + 1.
    struct Node {
        Box3d box;
        std::uint32_t first = 0;
        std::uint32_t count = 0;
    };
    // Depth is bounded by the build: it halves by count below this depth.
    static constexpr std::size_t max_depth = 64;

    struct Builder;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

template <class Key, class Limit, class Visit>
void BoxTree::visit_by(const Key& key, const Limit& limit, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<std::pair<double, std::uint32_t>, max_depth + 1> stack;
    std::size_t depth = 0;
    stack[depth++] = {key(nodes_[0].box), 0};
    while (depth > 0) {
        const auto [node_key, index] = stack[--depth];
        if (node_key >= limit()) continue;
        const Node& node = nodes_[index];
        if (node.count > 0) {
            for (std::uint32_t i = 0; i < node.count; ++i)
                visit(node.first + i);
            continue;
        }
        std::pair near{key(nodes_[node.first].box), node.first};
        std::pair far{key(nodes_[node.first + 1].box), node.first + 1};
        if (far.first < near.first) std::swap(near, far);
        assert(depth + 2 <= stack.size());
        if (far.first < limit()) stack[depth++] = far;
        stack[depth++] = near;
    }
}

template <class Matters, class Visit>
void BoxTree::visit_where(const Matters& matters, const Visit& visit) const {
    visit_by([&](const Box3d& box) { return matters(box) ? 0.0 : 1.0; }, [] { return 1.0; }, visit);
}

}  // namespace camdir::bake
