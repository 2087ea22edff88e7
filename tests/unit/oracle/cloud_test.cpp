// The oracle among the points of a cloud, by arithmetic.
#include <gtest/gtest.h>

#include "oracle/reachability.hpp"
#include "support/clouds.hpp"

namespace camdir::oracle {
namespace {

constexpr double radius = 0.15;

scene::Scene room() {
    scene::Scene scene;
    scene.points = test::walls_of(Box3d(Vec3d::Zero(), Vec3d(4.0, 3.0, 2.0)), 0.1);
    for (const Vec3d& point : scene.points)
        scene.bounds.extend(point);
    scene.bounds.extend(Vec3d(6.0, 3.0, 2.0));
    scene.spawn_points.push_back({Vec3d(1.0, 1.0, 1.0), 0.0, "seed"});
    return scene;
}

TEST(CloudOracle, ClearanceIsTheDistanceToTheNearestPointLessTheRadius) {
    const Oracle oracle(room(), radius);
    EXPECT_NEAR(oracle.clearance({1.0, 1.0, 0.5}), 0.5 - radius, 1e-9);
    EXPECT_NEAR(oracle.clearance({1.0, 1.0, 0.1}), 0.1 - radius, 1e-9);
    EXPECT_TRUE(oracle.in_solid({1.0, 1.0, 0.1}));
    EXPECT_FALSE(oracle.in_solid({1.0, 1.0, 0.2}));
    EXPECT_TRUE(oracle.ball_clear({1.0, 1.0, 1.0}, 0.8));
    EXPECT_FALSE(oracle.ball_clear({1.0, 1.0, 1.0}, 0.9));
}

TEST(CloudOracle, SegmentsEndAtWalls) {
    const Oracle oracle(room(), radius);
    EXPECT_TRUE(oracle.segment_clear({0.5, 0.5, 0.5}, {3.5, 2.5, 1.5}));
    EXPECT_FALSE(oracle.segment_clear({3.0, 1.5, 1.0}, {5.0, 1.5, 1.0}));
    EXPECT_TRUE(oracle.segment_clear({3.0, 1.5, 0.2}, {1.0, 1.5, 0.2}));
    EXPECT_FALSE(oracle.segment_clear({3.0, 1.5, 0.13}, {1.0, 1.5, 0.13}));
    EXPECT_TRUE(oracle.segment_clear({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}));
}

TEST(CloudOracle, BehindTheWallIsNotReachable) {
    const scene::Scene scene = room();
    const Oracle oracle(scene, radius);
    const Reachability reachability = Reachability::explore(oracle, scene, {}, {}).value();
    EXPECT_TRUE(reachability.reachable({3.8, 2.8, 1.8}));
    EXPECT_FALSE(reachability.reachable({5.0, 1.5, 1.0}));
    EXPECT_FALSE(reachability.reachable({3.95, 1.5, 1.0}));
}

}  // namespace
}  // namespace camdir::oracle
