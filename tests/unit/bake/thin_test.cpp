#include "bake/thin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace camdir::bake {
namespace {

std::vector<Vec3d> random_points(std::mt19937& random, int count) {
    std::uniform_real_distribution<double> coordinate(-5.0, 5.0);
    std::vector<Vec3d> points;
    for (int i = 0; i < count; ++i)
        points.emplace_back(coordinate(random), coordinate(random), coordinate(random));
    return points;
}

TEST(Thin, KeepsASparseSubsetThatCoversTheRest) {
    std::mt19937 random(3);
    const std::vector<Vec3d> points = random_points(random, 2000);
    const double distance = 0.5;
    Stage stage("thin", {}, {});
    const auto kept = thin(points, distance, stage).value();
    EXPECT_LT(kept.size(), points.size());
    const auto near = [&](const Vec3d& a) {
        return std::count_if(kept.begin(), kept.end(),
                             [&](const Vec3d& b) { return (a - b).norm() <= distance; });
    };
    for (const Vec3d& p : points)
        ASSERT_GE(near(p), 1);
    for (const Vec3d& p : kept) {
        ASSERT_EQ(near(p), 1) << "only itself";
        ASSERT_EQ(std::count(points.begin(), points.end(), p), 1);
    }
}

TEST(Thin, DoesNotDependOnTheOrder) {
    std::mt19937 random(4);
    std::vector<Vec3d> points = random_points(random, 1000);
    points.insert(points.end(), points.begin(), points.begin() + 100);
    Stage stage("thin", {}, {});
    const auto kept = thin(points, 0.5, stage).value();
    std::shuffle(points.begin(), points.end(), random);
    EXPECT_EQ(thin(points, 0.5, stage).value(), kept);
}

}  // namespace
}  // namespace camdir::bake
