#include "freespace/roadmap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "freespace/distance.hpp"
#include "freespace/visibility.hpp"
#include "support/freespace_meshes.hpp"
#include "support/freespace_twins.hpp"

namespace camdir::freespace {
namespace {

using test::covered_point;
using test::make_freespace;
using test::random_contents;
using test::square_contents;

double gap(const Freespace& freespace, const Vec3f& point, std::uint32_t vertex) {
    return (freespace.vertices()[vertex].position() - point).cast<double>().norm();
}

std::vector<std::uint32_t> entry_vertices(const Freespace& freespace, const Vec3f& point) {
    std::vector<std::uint32_t> vertices;
    const Distance slab = distance(freespace, point);
    if (!slab.covered()) return vertices;
    const auto [a, b, c] = freespace.triangles()[slab.triangle];
    for (const std::uint32_t v : {a, b, c})
        if (on_roadmap(freespace.vertices()[v])) vertices.push_back(v);
    return vertices;
}

// The length that the shortest path must have; infinity when there is none.
double twin_length(const Freespace& freespace, const Vec3f& from, const Vec3f& to) {
    const auto starts = entry_vertices(freespace, from);
    std::vector<double> costs;
    for (const std::uint32_t v : starts)
        costs.push_back(gap(freespace, from, v));
    const std::vector<double> distances = test::roadmap_distances(freespace, starts, costs);
    double length = std::numeric_limits<double>::infinity();
    for (const std::uint32_t v : entry_vertices(freespace, to))
        length = std::min(length, distances[v] + gap(freespace, to, v));
    return length;
}

void expect_edges_in_freespace(const Freespace& freespace, const RoadmapPath& path, const Vec3f& from,
                               const Vec3f& to) {
    ASSERT_FALSE(path.vertices.empty());
    const auto position = [&](std::uint32_t v) { return freespace.vertices()[v].position(); };
    EXPECT_TRUE(sight(freespace, from, position(path.vertices.front())).clear);
    EXPECT_TRUE(sight(freespace, position(path.vertices.back()), to).clear);
    double length = gap(freespace, from, path.vertices.front()) + gap(freespace, to, path.vertices.back());
    for (std::size_t i = 0; i + 1 < path.vertices.size(); ++i) {
        EXPECT_TRUE(sight(freespace, position(path.vertices[i]), position(path.vertices[i + 1])).clear);
        length += gap(freespace, position(path.vertices[i]), path.vertices[i + 1]);
    }
    EXPECT_NEAR(path.length, length, 1e-4 * length);
}

TEST(RoadmapEdges, AreThoseBetweenCornersInFreespaceOnce) {
    Contents contents = square_contents();
    const Freespace square = make_freespace(contents);
    EXPECT_EQ(roadmap_edges(square).size(), 5U) << "four sides and a diagonal";
    contents.vertices[0].free_distance = 0.0F;
    const Freespace cut = make_freespace(contents);
    const std::vector<RoadmapEdge> edges = roadmap_edges(cut);
    EXPECT_EQ(edges.size(), 3U);
    EXPECT_TRUE(std::ranges::is_sorted(edges));
    for (const auto& [from, to] : edges) {
        EXPECT_LT(from, to);
        EXPECT_TRUE(on_roadmap(cut.vertices()[from]) && on_roadmap(cut.vertices()[to]));
    }
}

TEST(RoadmapComponents, AreNumberedByTheirSmallestVertexAndJoinedByEdgesAlone) {
    std::mt19937 random(4);
    const Freespace freespace = make_freespace(random_contents(random, 12, 10, 60));
    const std::vector<std::uint32_t> component = roadmap_components(freespace);
    for (const auto& [from, to] : roadmap_edges(freespace))
        EXPECT_EQ(component[from], component[to]);
    for (std::uint32_t v = 0; v < component.size(); ++v) {
        ASSERT_EQ(component[v] == none, !on_roadmap(freespace.vertices()[v]));
        if (component[v] == none) continue;
        EXPECT_LE(component[v], v);
        const auto distances = test::roadmap_distances(freespace, {component[v]}, {0.0});
        EXPECT_LT(distances[v], std::numeric_limits<double>::infinity());
    }
}

TEST(Roadmap, CrossesASquareByItsCorners) {
    const Freespace freespace = make_freespace(square_contents());
    RoadmapSearch search(freespace);
    const RoadmapPath& path = search.find({0, 0, 5}, {100, 100, 5});
    ASSERT_TRUE(path.found);
    EXPECT_NEAR(path.length, 2.0F * std::hypot(100.0F, 5.0F), 1e-3F) << "by one of the shared corners";
    EXPECT_EQ(path.vertices.size(), 1U);
}

TEST(Roadmap, IsAsShortAsDijkstraSaysAndStaysInFreespace) {
    int found = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const Freespace freespace = make_freespace(random_contents(random, 12, 10, 20));
        RoadmapSearch search(freespace);
        for (int i = 0; i < 40; ++i) {
            const Vec3f from = covered_point(random, freespace);
            const Vec3f to = covered_point(random, freespace);
            const double expected = twin_length(freespace, from, to);
            const RoadmapPath& path = search.find(from, to);
            ASSERT_EQ(path.found, expected < std::numeric_limits<double>::infinity());
            if (!path.found) {
                EXPECT_TRUE(path.vertices.empty());
                continue;
            }
            ++found;
            EXPECT_NEAR(path.length, expected, 1e-4 * expected);
            expect_edges_in_freespace(freespace, path, from, to);
        }
    }
    EXPECT_GT(found, 20);
}

TEST(Roadmap, EarlierSearchesLeaveNoTrace) {
    std::mt19937 random(8);
    const Freespace freespace = make_freespace(random_contents(random, 12, 10, 5));
    RoadmapSearch used(freespace);
    for (int i = 0; i < 50; ++i) {
        const Vec3f from = covered_point(random, freespace);
        const Vec3f to = covered_point(random, freespace);
        RoadmapSearch fresh(freespace);
        EXPECT_EQ(used.find(from, to).vertices, fresh.find(from, to).vertices);
    }
}

TEST(Roadmap, PartsThatDoNotMeetAreNotJoined) {
    Contents contents = square_contents();
    contents.vertices.insert(contents.vertices.end(), {{300, 0, 0, 9}, {310, 0, 0, 9}, {300, 10, 0, 9}});
    contents.triangles.push_back({4, 5, 6});
    const Freespace freespace = make_freespace(contents);
    RoadmapSearch search(freespace);
    EXPECT_FALSE(search.find({50, 50, 0}, {302, 2, 0}).found);
    EXPECT_FALSE(search.find({50, 50, 0}, {200, 0, 0}).found) << "to a point in no slab";
    EXPECT_TRUE(search.find({304, 1, 0}, {302, 2, 0}).found);
}

TEST(Roadmap, DoesNotPassAVertexWithoutFreeDistance) {
    // A strip of triangles whose middle pair of corners is closed.
    Contents contents = test::empty_contents();
    for (int i = 0; i < 5; ++i) {
        const float x = 20.0F * static_cast<float>(i);
        const float radius = i == 2 ? -1.0F : 30.0F;
        contents.vertices.push_back({x, 0, 0, radius});
        contents.vertices.push_back({x, 20, 0, radius});
    }
    for (std::uint32_t i = 0; i < 8; ++i)
        contents.triangles.push_back({i, i + 1, i + 2});
    const Freespace freespace = make_freespace(contents);
    EXPECT_FALSE(RoadmapSearch(freespace).find({0, 0, 0}, {80, 0, 0}).found);
}

}  // namespace
}  // namespace camdir::freespace
