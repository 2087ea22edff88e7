#include "bake/delaunay.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "bake/geometry/circumcentre.hpp"

namespace camdir::bake {
namespace {

std::vector<Vec3d> random_points(std::mt19937& random, int count) {
    std::uniform_real_distribution<double> coordinate(-50.0, 50.0);
    std::vector<Vec3d> points;
    for (int i = 0; i < count; ++i)
        points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    return points;
}

// Every cube of it has eight points on one sphere.
std::vector<Vec3d> grid_points(int side) {
    std::vector<Vec3d> points;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (int z = 0; z < side; ++z)
                points.emplace_back(x, y, z);
    return points;
}

Delaunay triangulated(const std::vector<Vec3d>& points, double min_length) {
    Stage stage("delaunay", {}, {});
    return delaunay(points, std::vector<double>(points.size(), min_length), stage).value();
}

void expect_empty_spheres(const std::vector<Vec3d>& points, const Delaunay& result) {
    ASSERT_FALSE(result.cells.empty());
    for (const Cell& cell : result.cells) {
        const Vec3d centre =
            circumcentre({points[cell[0]], points[cell[1]], points[cell[2]], points[cell[3]]});
        const double radius = (points[cell[0]] - centre).norm();
        for (const Vec3d& p : points)
            ASSERT_GE((p - centre).norm(), radius * (1.0 - 1e-6));
    }
}

// The two samples that all cells of a face share.
std::pair<std::uint32_t, std::uint32_t> edge_of(const Delaunay& result, std::size_t face) {
    const Cell& first = result.cells[result.face(face)[0]];
    std::vector<std::uint32_t> shared(first.begin(), first.end());
    for (const std::uint32_t i : result.face(face)) {
        const Cell& cell = result.cells[i];
        std::erase_if(shared, [&](std::uint32_t sample) {
            return std::find(cell.begin(), cell.end(), sample) == cell.end();
        });
    }
    EXPECT_EQ(shared.size(), 2U);
    return {shared.front(), shared.back()};
}

// Every face goes around one edge: its cells share two samples, neighbours in it share a third.
void expect_faces_around_edges(const std::vector<Vec3d>& points, const Delaunay& result, double min_length) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t i = 0; i < result.face_count(); ++i) {
        const auto face = result.face(i);
        ASSERT_GE(face.size(), 3U);
        EXPECT_EQ(face[0], *std::min_element(face.begin(), face.end()));
        for (std::size_t k = 0; k < face.size(); ++k) {
            const Cell& cell = result.cells[face[k]];
            const Cell& next = result.cells[face[(k + 1) % face.size()]];
            std::vector<std::uint32_t> facet;
            std::set_intersection(cell.begin(), cell.end(), next.begin(), next.end(),
                                  std::back_inserter(facet));
            EXPECT_EQ(facet.size(), 3U);
        }
        const auto [a, b] = edge_of(result, i);
        EXPECT_EQ(result.generators[i], (Generators{a, b}));
        EXPECT_GE((points[a] - points[b]).norm(), min_length);
        EXPECT_TRUE(edges.emplace(a, b).second) << "each edge once";
    }
}

TEST(Delaunay, SpheresOfRandomPointsAreEmpty) {
    std::mt19937 random(10);
    const auto points = random_points(random, 400);
    const Delaunay result = triangulated(points, 20.0);
    expect_empty_spheres(points, result);
    EXPECT_GT(result.face_count(), 0U);
    expect_faces_around_edges(points, result, 20.0);
}

TEST(Delaunay, SpheresOfAGridAreEmpty) {
    const auto points = grid_points(6);
    const Delaunay result = triangulated(points, 1.2);
    expect_empty_spheres(points, result);
    EXPECT_GT(result.face_count(), 0U);
    expect_faces_around_edges(points, result, 1.2);
}

TEST(Delaunay, TheSmallerLengthDecidesWhichEdgesAreLong) {
    std::mt19937 random(12);
    const auto points = random_points(random, 300);
    std::vector<double> min_lengths;
    for (std::size_t i = 0; i < points.size(); ++i)
        min_lengths.push_back(random() % 2 == 0 ? 10.0 : 30.0);
    const auto edges_of = [&](const std::vector<double>& of) {
        Stage stage("delaunay", {}, {});
        const Delaunay result = delaunay(points, of, stage).value();
        std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
        for (std::size_t i = 0; i < result.face_count(); ++i)
            edges.push_back(edge_of(result, i));
        return edges;
    };
    auto expected = edges_of(std::vector<double>(points.size(), 0.0));
    std::erase_if(expected, [&](const auto& edge) {
        const auto [a, b] = edge;
        return (points[a] - points[b]).norm() < std::min(min_lengths[a], min_lengths[b]);
    });
    EXPECT_THAT(expected, testing::Not(testing::IsEmpty()));
    EXPECT_EQ(edges_of(min_lengths), expected);
}

TEST(Delaunay, OfShuffledPointsIsTheSameUpToNames) {
    std::mt19937 random(11);
    const auto points = grid_points(5);
    std::vector<std::uint32_t> order(points.size());
    for (std::uint32_t i = 0; i < order.size(); ++i)
        order[i] = i;
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Vec3d> shuffled;
    for (const std::uint32_t i : order)
        shuffled.push_back(points[i]);

    std::vector<Cell> renamed = triangulated(shuffled, 1.2).cells;
    for (Cell& cell : renamed) {
        for (std::uint32_t& sample : cell)
            sample = order[sample];
        std::sort(cell.begin(), cell.end());
    }
    std::sort(renamed.begin(), renamed.end());
    EXPECT_EQ(renamed, triangulated(points, 1.2).cells);
}

TEST(Delaunay, RefusesSamplesInOnePlane) {
    std::vector<Vec3d> points;
    for (int i = 0; i < 20; ++i)
        points.emplace_back(i % 5, i / 5, 7.0);
    Stage stage("delaunay", {}, {});
    const auto refused = delaunay(points, std::vector<double>(points.size(), 0.5), stage);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("one plane"));
}

}  // namespace
}  // namespace camdir::bake
