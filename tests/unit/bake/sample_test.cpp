#include "bake/sample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/bake_twins.hpp"

namespace camdir::bake {
namespace {

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

double to_nearest(const Vec3d& point, const std::vector<Vec3d>& samples) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Vec3d& s : samples)
        nearest2 = std::min(nearest2, (s - point).squaredNorm());
    return std::sqrt(nearest2);
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
            largest = std::max(largest, to_nearest(p, corners));
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
        const auto samples = sample(scene_of(t), distance, stage).value();
        for (const Vec3d& p : dense_points(t, 120))
            ASSERT_LT(to_nearest(p, samples), distance) << "round " << round;
        for (const Vec3d& s : samples)
            ASSERT_LT((closest_point(t, s) - s).norm(), 1e-9)
                << "samples lie on the triangle, round " << round;
    }
}

TEST(Sample, TrianglesThatAreFineEnoughGiveTheirCorners) {
    const Triangle3d t{Vec3d(0, 0, 0), Vec3d(5, 0, 0), Vec3d(0, 5, 0)};
    Stage stage("sample", {}, {});
    EXPECT_THAT(sample(scene_of(t), 4.0, stage).value(), testing::UnorderedElementsAre(t[0], t[1], t[2]));
}

TEST(Sample, RefusesWhatNeedsTooManySamples) {
    const Triangle3d t{Vec3d(0, 0, 0), Vec3d(1e6, 0, 0), Vec3d(0, 1e6, 0)};
    Stage stage("sample", {}, {});
    const auto refused = sample(scene_of(t), 4.0, stage);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("made.map"));
    EXPECT_THAT(refused.error().message, testing::HasSubstr("the limit is 20 million"));
    EXPECT_EQ(refused.error().code, ErrorCode::failed);
}

}  // namespace
}  // namespace camdir::bake
