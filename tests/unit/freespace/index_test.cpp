// Incidence and query index, which are made when a file is opened.
#include "freespace/index.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "freespace/incidence.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::freespace {
namespace {

using test::make_freespace;
using test::random_contents;

TEST(Incidence, IsTheTrianglesOfEachVertex) {
    std::mt19937 random(2);
    const Freespace freespace = make_freespace(random_contents(random, 9, 7, 10));
    for (std::uint32_t v = 0; v < freespace.vertices().size(); ++v) {
        std::vector<std::uint32_t> expected;
        for (std::uint32_t t = 0; t < freespace.triangles().size(); ++t) {
            const auto [a, b, c] = freespace.triangles()[t];
            if (a == v || b == v || c == v) expected.push_back(t);
        }
        EXPECT_THAT(freespace.incident(v), testing::ElementsAreArray(expected)) << "vertex " << v;
    }
}

Box3f box_of(const IndexNode::Boxes& boxes, std::uint32_t k) {
    return {Vec3f(boxes.low[0][k], boxes.low[1][k], boxes.low[2][k]),
            Vec3f(boxes.high[0][k], boxes.high[1][k], boxes.high[2][k])};
}

// The child's box holds the vertex, its reach the ball around it, and its radius is no smaller.
bool encloses(const IndexNode& node, std::uint32_t k, const Vertex& vertex) {
    const float r = std::max(vertex.free_distance, 0.0F);
    const Box3f box = box_of(node.box, k);
    const Box3f reach = box_of(node.reach, k);
    const Vec3f p = vertex.position();
    return box.contains(p) && reach.contains(Vec3f(p.array() - r)) && reach.contains(Vec3f(p.array() + r)) &&
           node.max_radius[k] >= vertex.free_distance;
}

// Visits the triangles below a node; every child must enclose all of its own.
class Walk {
  public:
    Walk(const Contents& contents, const std::vector<IndexNode>& nodes)
        : contents_(contents), nodes_(nodes), visits_(contents.triangles.size()) {
        if (!nodes.empty()) visit(0, 1);
    }
    [[nodiscard]] const std::vector<int>& visits() const { return visits_; }
    [[nodiscard]] std::uint32_t depth() const { return depth_; }
    [[nodiscard]] int outside() const { return outside_; }

  private:
    std::vector<std::uint32_t> visit(std::uint32_t number, std::uint32_t depth) {
        depth_ = std::max(depth_, depth);
        const IndexNode& node = nodes_[number];
        std::vector<std::uint32_t> all;
        for (std::uint32_t k = 0; k < IndexNode::width; ++k) {
            const IndexChild child(node.child[k]);
            std::vector<std::uint32_t> below;
            if (!child.is_leaf()) below = visit(child.index(), depth + 1);
            for (std::uint32_t i = 0; child.is_leaf() && i < child.count(); ++i) {
                below.push_back(child.first() + i);
                ++visits_[child.first() + i];
            }
            for (const std::uint32_t t : below)
                for (const std::uint32_t corner :
                     {contents_.triangles[t].a, contents_.triangles[t].b, contents_.triangles[t].c})
                    outside_ += encloses(node, k, contents_.vertices[corner]) ? 0 : 1;
            all.insert(all.end(), below.begin(), below.end());
        }
        return all;
    }

    const Contents& contents_;
    const std::vector<IndexNode>& nodes_;
    std::vector<int> visits_;
    std::uint32_t depth_ = 0;
    int outside_ = 0;
};

TEST(Index, HoldsEveryTriangleOnceInWhateverOrder) {
    std::mt19937 random(7);
    for (const int loose : {0, 1, 3, 17, 100, 400, 1607, 5000}) {
        SCOPED_TRACE(loose);
        const Contents contents = random_contents(random, 2, 2, loose);
        const std::vector<IndexNode> nodes = build_index(contents.vertices, contents.triangles);
        const Walk walk(contents, nodes);
        EXPECT_THAT(walk.visits(), testing::Each(1));
        EXPECT_EQ(walk.outside(), 0);
        EXPECT_LE(walk.depth(), 6U) << "4^7 triangles";
        const std::size_t leaves = (contents.triangles.size() + IndexChild::leaf_capacity - 1) / 4;
        EXPECT_LE(nodes.size(), leaves / 3 + 8) << "nodes are full";
    }
}

TEST(Index, OfNothingIsEmpty) {
    EXPECT_TRUE(build_index({}, {}).empty());
    EXPECT_TRUE(index_order({}, {}).empty());
}

// The sum of the volumes of the leaves' boxes stands for the work of queries.
double volume_of_leaves(const std::vector<IndexNode>& nodes) {
    double volume = 0.0;
    for (const IndexNode& node : nodes)
        for (std::uint32_t k = 0; k < IndexNode::width; ++k)
            if (IndexChild(node.child[k]).is_leaf() && IndexChild(node.child[k]).count() > 0)
                volume += double{box_of(node.box, k).volume()};
    return volume;
}

TEST(Index, OrderBringsTogetherWhatIsNear) {
    std::mt19937 random(8);
    const Contents contents = random_contents(random, 60, 40, 0);
    const std::vector<std::uint32_t> order = index_order(contents.vertices, contents.triangles);
    std::vector<std::uint32_t> sorted = order;
    std::ranges::sort(sorted);
    for (std::uint32_t i = 0; i < sorted.size(); ++i)
        ASSERT_EQ(sorted[i], i) << "a permutation";
    std::vector<Triangle> ordered, shuffled = contents.triangles;
    for (const std::uint32_t t : order)
        ordered.push_back(contents.triangles[t]);
    std::ranges::shuffle(shuffled, random);
    EXPECT_LT(volume_of_leaves(build_index(contents.vertices, ordered)),
              0.1 * volume_of_leaves(build_index(contents.vertices, shuffled)));
    EXPECT_EQ(index_order(contents.vertices, ordered), sorted) << "what is in order stays";
}

}  // namespace
}  // namespace camdir::freespace
