#include "bake/sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <random>

#include "bake/bisection.hpp"
#include "bake/thin.hpp"
#include "support/bake_twins.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

const scene::Scene empty_scene;
const Solids no_solids(empty_scene);

Triangle3d random_triangle(std::mt19937& random, double size) {
    std::uniform_real_distribution<double> coordinate(-size, size);
    Triangle3d t;
    for (Vec3d& p : t)
        p = {coordinate(random), coordinate(random), coordinate(random)};
    // A third of them are needles.
    if (random() % 3 == 0) t[2] = 0.5 * (t[0] + t[1]) + 0.02 * t[2];
    return t;
}

scene::Scene scene_of(const Triangle3d& t) {
    scene::Scene scene;
    scene.source = "made.map";
    scene.vertices.assign(t.begin(), t.end());
    scene.triangles = {{0, 1, 2}};
    return scene;
}

// The points of a fine barycentric grid.
std::vector<Vec3d> dense_points(const Triangle3d& t, int steps) {
    std::vector<Vec3d> points;
    for (int i = 0; i <= steps; ++i)
        for (int j = 0; i + j <= steps; ++j) {
            const double u = static_cast<double>(i) / steps;
            const double v = static_cast<double>(j) / steps;
            points.push_back(test::point_of(t, {1.0 - u - v, u, v}));
        }
    return points;
}

TEST(CoveringRadius, IsTheLargestDistanceToTheNearestCorner) {
    std::mt19937 random(1);
    for (int round = 0; round < 200; ++round) {
        const Triangle3d t = random_triangle(random, 10.0);
        const std::vector<Vec3d> corners(t.begin(), t.end());
        double largest = 0.0;
        for (const Vec3d& p : dense_points(t, 200))
            largest = std::max(largest, test::distance_to_nearest(p, corners));
        EXPECT_GE(covering_radius(t), largest - 1e-9) << "round " << round;
        EXPECT_LE(covering_radius(t), largest + 0.2) << "round " << round;
    }
}

TEST(CoveringRadius, OfAPointIsZero) {
    const Vec3d p(1, 2, 3);
    EXPECT_EQ(covering_radius({p, p, p}), 0.0);
}

TEST(CoveringRadius, OfASegmentIsHalfItsLength) {
    const Vec3d a(0, 0, 0);
    const Vec3d b(6, 0, 0);
    EXPECT_EQ(covering_radius({a, b, b}), 3.0);
    EXPECT_EQ(covering_radius({a, b, a}), 3.0);
}

TEST(Sample, EveryObstaclePointHasASampleNearerThanTheDistance) {
    std::mt19937 random(2);
    for (int round = 0; round < 60; ++round) {
        const Triangle3d t = random_triangle(random, 40.0);
        const double distance = 4.0;
        Stage stage("sample", {}, {});
        const auto samples = sample(scene_of(t), no_solids, SamplingDistance(distance), 0.0, stage).value();
        for (const Vec3d& p : dense_points(t, 120))
            ASSERT_LT(test::distance_to_nearest(p, samples), distance) << "round " << round;
        for (const Vec3d& s : samples)
            ASSERT_LT((closest_point(t, s) - s).norm(), 1e-9)
                << "samples lie on the triangle, round " << round;
    }
}

// Twenty triangles around the origin.
scene::Scene random_soup(std::mt19937& random) {
    scene::Scene scene;
    scene.source = "made.map";
    for (std::uint32_t i = 0; i < 20; ++i) {
        const Triangle3d t = random_triangle(random, 40.0);
        scene.vertices.insert(scene.vertices.end(), t.begin(), t.end());
        scene.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return scene;
}

SamplingDistance random_distance(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-60.0, 60.0);
    std::vector<Vec3d> medial_axis;
    for (int i = 0; i < 10; ++i)
        medial_axis.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    return {2.0, 30.0, medial_axis};
}

TEST(Sample, NearestSamplesAreNearerThanTheirSamplingDistance) {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        const scene::Scene soup = random_soup(random);
        const SamplingDistance distance = random_distance(random);
        Stage stage("sample", {}, {});
        const double welded = 0.1;
        const auto samples =
            thin(sample(soup, no_solids, distance, welded, stage).value(), welded, stage).value();
        for (const auto& [a, b, c] : soup.triangles)
            for (const Vec3d& x : dense_points({soup.vertices[a], soup.vertices[b], soup.vertices[c]}, 40)) {
                const double nearest = test::distance_to_nearest(x, samples);
                for (const Vec3d& p : samples) {
                    if ((p - x).norm() > nearest + 1e-9) continue;
                    ASSERT_LT(nearest, distance.at(p)) << "round " << round;
                }
            }
    }
}

// The pillar's ends are buried, and so are the parts of floor and ceiling behind them.
TEST(Sample, OnlyWhatBoundsFreeSpaceNeedsSamples) {
    const test::SolidScene room = test::pillar_room();
    const scene::Scene& scene = room.scene();
    const Solids solids(scene);
    const double distance = 4.0;
    Stage stage("sample", {}, {});
    const auto samples = sample(scene, solids, SamplingDistance(distance), 0.0, stage).value();
    const auto everywhere = sample(scene, no_solids, SamplingDistance(distance), 0.0, stage).value();
    EXPECT_LT(samples.size(), everywhere.size());
    std::size_t bounding = 0;
    for (const auto& [a, b, c] : scene.triangles) {
        const Triangle3d t{scene.vertices[a], scene.vertices[b], scene.vertices[c]};
        const Vec3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
        for (const Vec3d& p : dense_points(t, 40)) {
            if (solids.contains(p + 0.1 * normal) && solids.contains(p - 0.1 * normal)) continue;
            ++bounding;
            ASSERT_LT(test::distance_to_nearest(p, samples), distance);
        }
    }
    EXPECT_GT(bounding, 1000U);
}

TEST(Sample, IsSparseFarFromTheMedialAxis) {
    std::mt19937 random(4);
    const scene::Scene soup = random_soup(random);
    const SamplingDistance adaptive = random_distance(random);
    Stage stage("sample", {}, {});
    const auto sparse = sample(soup, no_solids, adaptive, 0.0, stage).value();
    const auto dense = sample(soup, no_solids, SamplingDistance(adaptive.finest()), 0.0, stage).value();
    EXPECT_LT(3 * sparse.size(), dense.size());
}

TEST(Sample, TrianglesWithACommonEdgeHaveTheSameSamplesThere) {
    std::mt19937 random(5);
    for (int round = 0; round < 20; ++round) {
        scene::Scene pair = random_soup(random);
        // The second one has the first one's edge, in the other direction.
        pair.triangles = {{0, 1, 2}, {1, 0, 3}};
        const SamplingDistance distance = random_distance(random);
        Stage stage("sample", {}, {});
        const auto samples = sample(pair, no_solids, distance, 0.0, stage).value();
        const Vec3d& a = pair.vertices[0];
        const Vec3d& b = pair.vertices[1];
        // Samples of the common edge are repeated midpoints of it; no other samples lie this near to it.
        std::vector<double> along;
        for (const Vec3d& p : samples)
            if ((closest_point(a, b, p) - p).norm() < 1e-9) along.push_back((p - a).norm() / (b - a).norm());
        std::sort(along.begin(), along.end());
        along.erase(std::unique(along.begin(), along.end()), along.end());
        for (std::size_t i = 1; i < along.size(); ++i)
            ASSERT_GT(along[i] - along[i - 1], 1e-6) << "no two samples almost coincide, round " << round;
    }
}

TEST(Sample, IsTheSameForAnyNumberOfThreads) {
    std::mt19937 random(6);
    const scene::Scene soup = random_soup(random);
    const SamplingDistance distance = random_distance(random);
    const auto sampled = [&](int threads) {
        return tbb::task_arena(threads).execute([&] {
            Stage stage("sample", {}, {});
            return sample(soup, no_solids, distance, 0.0, stage).value();
        });
    };
    EXPECT_EQ(sampled(1), sampled(2));
}

TEST(SamplingDistance, IsThreeQuartersOfTheDistanceToTheMedialAxisWithinItsLimits) {
    const SamplingDistance distance(4.0, 20.0, {Vec3d(0, 0, 0), Vec3d(100, 0, 0)});
    EXPECT_EQ(distance.at({0, 0, 0}), 4.0);
    EXPECT_EQ(distance.at({0, 5, 0}), 4.0);
    EXPECT_EQ(distance.at({0, 20, 0}), 15.0);
    EXPECT_EQ(distance.at({84, 0, 0}), 12.0);
    EXPECT_EQ(distance.at({0, 500, 0}), 20.0);
    EXPECT_EQ(SamplingDistance(4.0).at({1, 2, 3}), 4.0);
}

TEST(Sample, TrianglesThatAreFineEnoughGiveTheirCorners) {
    const Triangle3d t{Vec3d(0, 0, 0), Vec3d(5, 0, 0), Vec3d(0, 5, 0)};
    Stage stage("sample", {}, {});
    EXPECT_THAT(sample(scene_of(t), no_solids, SamplingDistance(4.0), 0.0, stage).value(),
                testing::UnorderedElementsAre(t[0], t[1], t[2]));
}

TEST(Sample, RefusesWhatNeedsTooManySamples) {
    const Triangle3d t{Vec3d(0, 0, 0), Vec3d(1e6, 0, 0), Vec3d(0, 1e6, 0)};
    const auto refused = check_sample_count(scene_of(t), 4.0, 4.0);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("made.map"));
    EXPECT_THAT(refused.error().message, testing::HasSubstr("the limit is 20 million"));
    EXPECT_EQ(refused.error().code, ErrorCode::failed);
    EXPECT_TRUE(check_sample_count(scene_of(t), 4000.0, 4.0));
}

TEST(Sample, StopsWhereManyTrianglesNeedAFewSamplesEach) {
    scene::Scene scene = scene_of({Vec3d(0, 0, 0), Vec3d(100, 0, 0), Vec3d(0, 100, 0)});
    scene.triangles.resize(50, scene.triangles[0]);
    Stage stage("sample", {}, {});
    const std::size_t all = sample(scene, no_solids, SamplingDistance(4.0), 0.0, stage).value().size();
    ASSERT_LT(all / 50, 1024U);
    EXPECT_TRUE(sample(scene, no_solids, SamplingDistance(4.0), 0.0, stage, all));
    EXPECT_FALSE(sample(scene, no_solids, SamplingDistance(4.0), 0.0, stage, all - 1));
    EXPECT_FALSE(sample(scene, no_solids, SamplingDistance(4.0), 0.0, stage, 1));
}

}  // namespace
}  // namespace camdir::bake
