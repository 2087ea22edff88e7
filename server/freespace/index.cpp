#include "freespace/index.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace camdir::freespace {
namespace {

using Point4 = std::array<float, 4>;  // x, y, z, free distance
constexpr float infinity = std::numeric_limits<float>::infinity();

// Box of the corners in x, y, z and free distance.
struct Extent {
    Point4 low{infinity, infinity, infinity, infinity};
    Point4 high{-infinity, -infinity, -infinity, -infinity};

    void enclose(const Point4& point) {
        for (std::size_t axis = 0; axis < 4; ++axis) {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
        }
    }
    [[nodiscard]] std::size_t widest_axis() const {
        std::size_t widest = 0;
        for (std::size_t axis = 1; axis < 4; ++axis)
            if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
        return widest;
    }
};

Point4 coordinates(const Vertex& vertex) {
    return {vertex.x, vertex.y, vertex.z, vertex.free_distance};
}

// A contiguous part of the order being built.
struct Range {
    std::uint32_t begin, end;

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

class Builder {
  public:
    Builder(std::span<const Vertex> vertices, std::span<const Triangle> triangles)
        : vertices_(vertices), triangles_(triangles), order_(triangles.size()) {
        for (std::uint32_t i = 0; i < order_.size(); ++i)
            order_[i] = i;
        centroids_.reserve(triangles.size());
        for (const auto& [a, b, c] : triangles)
            centroids_.push_back(centroid(a, b, c));
    }

    Index build() {
        Index index;
        if (triangles_.empty()) return index;
        std::vector<Range> level = {{0, static_cast<std::uint32_t>(order_.size())}};
        std::uint32_t node_count = 1;
        while (!level.empty()) {
            std::vector<Range> next;
            for (const Range& range : level)
                index.nodes.push_back(make_node(range, node_count, next, index.triangle_order));
            level = std::move(next);
        }
        return index;
    }

  private:
    [[nodiscard]] Point4 centroid(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        Point4 sum{};
        for (const std::uint32_t corner : {a, b, c}) {
            const Point4 point = coordinates(vertices_[corner]);
            for (std::size_t axis = 0; axis < 4; ++axis)
                sum[axis] += point[axis] / 3.0F;
        }
        return sum;
    }

    IndexNode make_node(Range range, std::uint32_t& node_count, std::vector<Range>& next,
                        std::vector<std::uint32_t>& triangle_order) {
        const std::uint32_t full = full_child(range);
        const auto [left, right] = split(range, full);
        const auto [first, second] = split(left, full);
        const auto [third, fourth] = split(right, full);
        const std::array<Range, IndexNode::width> children = {first, second, third, fourth};
        IndexNode node{};
        for (std::uint32_t k = 0; k < IndexNode::width; ++k) {
            const Range& child = children[k];
            set_bounds(node, k, child);
            if (child.size() > IndexChild::leaf_capacity) {
                node.child[k] = IndexChild::node(node_count++).bits();
                next.push_back(child);
                continue;
            }
            const auto position = static_cast<std::uint32_t>(triangle_order.size());
            node.child[k] = IndexChild::leaf(child.size() == 0 ? 0 : position, child.size()).bits();
            const auto begin = order_.begin() + child.begin;
            const auto end = order_.begin() + child.end;
            std::sort(begin, end);
            triangle_order.insert(triangle_order.end(), begin, end);
        }
        return node;
    }

    // How many triangles a child holds that is full, as all children but the last are: so there are as few
    // nodes as the triangles allow.
    static std::uint32_t full_child(Range range) {
        std::uint32_t size = IndexChild::leaf_capacity;
        while (size * IndexNode::width < range.size())
            size *= IndexNode::width;
        return size;
    }

    // Two parts, the first of full children. Ties go by number and leaves are sorted, so that the result does
    // not depend on the library's selection algorithm.
    std::pair<Range, Range> split(Range range, std::uint32_t full) {
        if (range.size() <= full) return {range, {range.end, range.end}};
        Extent extent;
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            extent.enclose(centroids_[order_[i]]);
        const std::size_t axis = extent.widest_axis();
        const std::uint32_t children = (range.size() + full - 1) / full;
        const std::uint32_t middle = range.begin + (children / 2) * full;
        const auto before = [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(centroids_[a][axis], a) < std::pair(centroids_[b][axis], b);
        };
        const auto begin = order_.begin();
        std::nth_element(begin + range.begin, begin + middle, begin + range.end, before);
        return {{range.begin, middle}, {middle, range.end}};
    }

    void set_bounds(IndexNode& node, std::uint32_t k, Range range) const {
        Extent box;
        Extent reach;
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const auto [a, b, c] = triangles_[order_[i]];
            for (const std::uint32_t corner : {a, b, c}) {
                const auto [x, y, z, free_distance] = coordinates(vertices_[corner]);
                const float radius = std::max(free_distance, 0.0F);
                box.enclose({x, y, z, free_distance});
                reach.enclose({x - radius, y - radius, z - radius, radius});
                reach.enclose({x + radius, y + radius, z + radius, radius});
            }
        }
        node.min_x[k] = box.low[0];
        node.min_y[k] = box.low[1];
        node.min_z[k] = box.low[2];
        node.max_x[k] = box.high[0];
        node.max_y[k] = box.high[1];
        node.max_z[k] = box.high[2];
        node.reach_min_x[k] = reach.low[0];
        node.reach_min_y[k] = reach.low[1];
        node.reach_min_z[k] = reach.low[2];
        node.reach_max_x[k] = reach.high[0];
        node.reach_max_y[k] = reach.high[1];
        node.reach_max_z[k] = reach.high[2];
        node.max_radius[k] = box.high[3];
    }

    std::span<const Vertex> vertices_;
    std::span<const Triangle> triangles_;
    std::vector<std::uint32_t> order_;
    std::vector<Point4> centroids_;
};

}  // namespace

Index build_index(std::span<const Vertex> vertices, std::span<const Triangle> triangles) {
    return Builder(vertices, triangles).build();
}

}  // namespace camdir::freespace
