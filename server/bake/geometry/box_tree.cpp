#include "bake/geometry/box_tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace camdir::bake {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr int bins = 16;

double surface(const Box3d& box) {
    if (box.isEmpty()) return 0.0;
    const Vec3d size = box.sizes();
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

struct Bin {
    Box3d box;
    std::uint32_t count = 0;
};

struct Split {
    int axis = -1;
    int bin = 0;  // items of bins <= bin go left
    double cost = std::numeric_limits<double>::infinity();
};

// Maps a centre to its bin along one axis.
struct Binning {
    double origin;
    double scale;

    [[nodiscard]] int operator()(double centre) const {
        return std::min(bins - 1, static_cast<int>((centre - origin) * scale));
    }
};

Binning binning(const Box3d& centres, int axis) {
    return {centres.min()[axis], bins / (centres.max()[axis] - centres.min()[axis])};
}

Split cheapest_split(const std::array<Bin, bins>& filled, int axis) {
    std::array<double, bins> right_cost{};
    Bin right;
    for (int i = bins - 1; i > 0; --i) {
        right.box.extend(filled[i].box);
        right.count += filled[i].count;
        right_cost[i] = surface(right.box) * right.count;
    }
    const std::uint32_t total = right.count + filled[0].count;
    Split best;
    Bin left;
    for (int i = 0; i + 1 < bins; ++i) {
        left.box.extend(filled[i].box);
        left.count += filled[i].count;
        const double cost = surface(left.box) * left.count + right_cost[i + 1];
        const bool both_sides = left.count > 0 && left.count < total;
        if (both_sides && cost < best.cost) best = {axis, i, cost};
    }
    return best;
}

}  // namespace

struct BoxTree::Builder {
    BoxTree& tree;
    std::span<const Box3d> boxes;

    void build(std::uint32_t node, std::uint32_t first, std::uint32_t last, std::size_t depth) {
        Box3d box;
        Box3d centres;
        for (std::uint32_t i = first; i < last; ++i) {
            box.extend(boxes[tree.order_[i]]);
            centres.extend(boxes[tree.order_[i]].center());
        }
        tree.nodes_[node] = {box, first, last - first};
        if (last - first <= leaf_size) return;

        const std::uint32_t middle = partition(first, last, centres, depth);
        const auto children = static_cast<std::uint32_t>(tree.nodes_.size());
        tree.nodes_.resize(tree.nodes_.size() + 2);
        tree.nodes_[node].first = children;
        tree.nodes_[node].count = 0;
        build(children, first, middle, depth + 1);
        build(children + 1, middle, last, depth + 1);
    }

    // Reorders the items by the surface area heuristic; halves by count where it finds no split or
    // when the tree became deep.
    std::uint32_t partition(std::uint32_t first, std::uint32_t last, const Box3d& centres,
                            std::size_t depth) {
        Split best;
        for (int axis = 0; axis < 3 && depth < max_depth / 2; ++axis) {
            const Binning bin_of = binning(centres, axis);
            if (!std::isfinite(bin_of.scale)) continue;
            std::array<Bin, bins> filled;
            for (std::uint32_t i = first; i < last; ++i) {
                const Box3d& box = boxes[tree.order_[i]];
                Bin& bin = filled[bin_of(box.center()[axis])];
                bin.box.extend(box);
                ++bin.count;
            }
            const Split split = cheapest_split(filled, axis);
            if (split.cost < best.cost) best = split;
        }
        const auto begin = tree.order_.begin() + first;
        const auto end = tree.order_.begin() + last;
        if (best.axis >= 0) {
            const Binning bin_of = binning(centres, best.axis);
            const auto middle = std::stable_partition(begin, end, [&](std::uint32_t item) {
                return bin_of(boxes[item].center()[best.axis]) <= best.bin;
            });
            return static_cast<std::uint32_t>(middle - tree.order_.begin());
        }
        return first + (last - first) / 2;
    }
};

BoxTree::BoxTree(std::span<const Box3d> boxes) : order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (boxes.empty()) return;
    nodes_.resize(1);
    Builder{*this, boxes}.build(0, 0, static_cast<std::uint32_t>(boxes.size()), 0);
}

}  // namespace camdir::bake
