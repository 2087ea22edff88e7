#include "freespace/index.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <utility>

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

// A range of positions in the order.
struct Range {
    std::uint32_t begin, end;

    [[nodiscard]] std::uint32_t size() const { return end - begin; }
};

// Number of triangles in a full child. All children but the last are full, so that there are as few nodes as
// possible.
std::uint32_t full_child(const Range& range) {
    std::uint32_t size = IndexChild::leaf_capacity;
    while (size * IndexNode::width < range.size())
        size *= IndexNode::width;
    return size;
}

// The first half consists of full children; the second may be empty.
std::array<Range, 2> halves_of(const Range& range, std::uint32_t full) {
    if (range.size() <= full) return {range, Range{range.end, range.end}};
    const std::uint32_t children = (range.size() + full - 1) / full;
    const std::uint32_t middle = range.begin + (children / 2) * full;
    return {Range{range.begin, middle}, Range{middle, range.end}};
}

std::array<Range, IndexNode::width> children_of(const Range& range) {
    const std::uint32_t full = full_child(range);
    const auto [left, right] = halves_of(range, full);
    const auto [first, second] = halves_of(left, full);
    const auto [third, fourth] = halves_of(right, full);
    return {first, second, third, fourth};
}

// ---- The order ----

class Order {
  public:
    Order(std::span<const Vertex> vertices, std::span<const Triangle> triangles) : order_(triangles.size()) {
        std::iota(order_.begin(), order_.end(), 0U);
        centroids_.reserve(triangles.size());
        for (const auto& [a, b, c] : triangles)
            centroids_.push_back(centroid(vertices[a], vertices[b], vertices[c]));
    }

    std::vector<std::uint32_t> make() {
        std::vector<Range> open = {{0, static_cast<std::uint32_t>(order_.size())}};
        while (!open.empty()) {
            const Range range = open.back();
            open.pop_back();
            if (range.size() <= IndexChild::leaf_capacity) {
                std::sort(order_.begin() + range.begin, order_.begin() + range.end);
                continue;
            }
            const std::uint32_t full = full_child(range);
            split(range, full);
            for (const Range& half : halves_of(range, full))
                split(half, full);
            for (const Range& child : children_of(range))
                open.push_back(child);
        }
        return std::move(order_);
    }

  private:
    static Point4 centroid(const Vertex& a, const Vertex& b, const Vertex& c) {
        Point4 sum{};
        for (const Vertex& corner : {a, b, c}) {
            const Point4 point = coordinates(corner);
            for (std::size_t axis = 0; axis < 4; ++axis)
                sum[axis] += point[axis] / 3.0F;
        }
        return sum;
    }

    // Partitions the range into its halves. Ties are broken by index and leaves are sorted, so that the
    // result does not depend on the library's selection algorithm.
    void split(const Range& range, std::uint32_t full) {
        const std::uint32_t middle = halves_of(range, full)[0].end;
        if (middle == range.end) return;
        Extent extent;
        for (std::uint32_t i = range.begin; i < range.end; ++i)
            extent.enclose(centroids_[order_[i]]);
        const std::size_t axis = extent.widest_axis();
        const auto before = [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(centroids_[a][axis], a) < std::pair(centroids_[b][axis], b);
        };
        const auto begin = order_.begin();
        std::nth_element(begin + range.begin, begin + middle, begin + range.end, before);
    }

    std::vector<std::uint32_t> order_;
    std::vector<Point4> centroids_;
};

// ---- The nodes ----

Box3f box_at(const IndexNode::Boxes& boxes, std::uint32_t k) {
    return {Vec3f(boxes.low[0][k], boxes.low[1][k], boxes.low[2][k]),
            Vec3f(boxes.high[0][k], boxes.high[1][k], boxes.high[2][k])};
}

void set_box(IndexNode::Boxes& boxes, std::uint32_t k, const Box3f& box) {
    for (int axis = 0; axis < 3; ++axis) {
        boxes.low[axis][k] = box.min()[axis];
        boxes.high[axis][k] = box.max()[axis];
    }
}

// Bounds of the triangles below a child: of their corners (box) and of the balls around these (reach).
struct Bounds {
    Box3f box;
    Box3f reach;
    float max_radius = -infinity;

    void enclose(const Vertex& corner) {
        const Vec3f position = corner.position();
        const Vec3f radius = Vec3f::Constant(std::max(corner.free_distance, 0.0F));
        box.extend(position);
        reach.extend(position - radius);
        reach.extend(position + radius);
        max_radius = std::max(max_radius, corner.free_distance);
    }
    void enclose(const IndexNode& node) {
        for (std::uint32_t k = 0; k < IndexNode::width; ++k) {
            box.extend(box_at(node.box, k));
            reach.extend(box_at(node.reach, k));
            max_radius = std::max(max_radius, node.max_radius[k]);
        }
    }
};

// The nodes and their children; bounds are not set.
std::vector<IndexNode> make_nodes(std::uint32_t triangle_count) {
    std::vector<IndexNode> nodes;
    std::vector<Range> ranges;  // of the nodes
    if (triangle_count > 0) ranges.push_back({0, triangle_count});
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        IndexNode& node = nodes.emplace_back();
        std::uint32_t k = 0;
        for (const Range& child : children_of(ranges[i])) {
            const bool is_leaf = child.size() <= IndexChild::leaf_capacity;
            const IndexChild made = is_leaf ? IndexChild::leaf(child.begin, child.size())
                                            : IndexChild::node(static_cast<std::uint32_t>(ranges.size()));
            node.child[k++] = made.bits();
            if (!is_leaf) ranges.push_back(child);
        }
    }
    return nodes;
}

}  // namespace

std::vector<std::uint32_t> index_order(std::span<const Vertex> vertices,
                                       std::span<const Triangle> triangles) {
    return Order(vertices, triangles).make();
}

std::vector<IndexNode> build_index(std::span<const Vertex> vertices, std::span<const Triangle> triangles) {
    std::vector<IndexNode> nodes = make_nodes(static_cast<std::uint32_t>(triangles.size()));
    for (std::size_t i = nodes.size(); i-- > 0;) {  // children come after their parents
        for (std::uint32_t k = 0; k < IndexNode::width; ++k) {
            const IndexChild child(nodes[i].child[k]);
            Bounds bounds;
            if (child.is_leaf())
                for (const auto& [a, b, c] : triangles.subspan(child.first(), child.count()))
                    for (const std::uint32_t corner : {a, b, c})
                        bounds.enclose(vertices[corner]);
            else
                bounds.enclose(nodes[child.index()]);
            set_box(nodes[i].box, k, bounds.box);
            set_box(nodes[i].reach, k, bounds.reach);
            nodes[i].max_radius[k] = bounds.max_radius;
        }
    }
    return nodes;
}

}  // namespace camdir::freespace
