// Real maps.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/load.hpp"
#include "support/openarena.hpp"
#include "support/oracle_twins.hpp"
#include "support/shared_files.hpp"

namespace camdir::scene {
namespace {

class RealMap : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        const auto source = test::openarena_map(GetParam());
        if (!source) GTEST_SKIP() << test::needs_openarena_map(GetParam());
        scene_ = load(*source).value();
    }
    Scene scene_;
};

TEST_P(RealMap, KeepsThePromisesOfAScene) {
    EXPECT_EQ(scene_.name, GetParam());
    EXPECT_GT(scene_.triangles.size(), 2000U);
    EXPECT_GT(scene_.brushes.size(), 500U);
    for (const auto& [a, b, c] : scene_.triangles) {
        ASSERT_LT(std::max({a, b, c}), scene_.vertices.size());
        const Vec3d& corner = scene_.vertices[a];
        ASSERT_GT((scene_.vertices[b] - corner).cross(scene_.vertices[c] - corner).norm(), 0.0);
    }
    for (const Vec3d& vertex : scene_.vertices) {
        ASSERT_TRUE(scene_.bounds.contains(vertex));
    }
    for (const Plane& plane : scene_.planes) {
        ASSERT_NEAR(plane.normal.norm(), 1.0, 1e-12);
    }
}

TEST_P(RealMap, SpawnPointsAreFree) {
    EXPECT_GE(scene_.spawn_points.size(), 4U);
    for (const SpawnPoint& spawn : scene_.spawn_points) {
        EXPECT_GT(test::clearance(scene_, spawn.eye), 10.0) << spawn.eye.transpose();
    }
}

TEST_P(RealMap, ReadsTheSameTwice) {
    const Scene again = load(scene_.source).value();
    EXPECT_EQ(again.source_hash, scene_.source_hash);
    EXPECT_EQ(again.triangles, scene_.triangles);
    EXPECT_EQ(again.vertices, scene_.vertices);
}

// Maps of Quake and GoldSrc, whose volumes and surfaces come from the tree.
class TreeMap : public testing::TestWithParam<std::string> {
  protected:
    void SetUp() override {
        const std::string name = "maps/" + GetParam() + ".bsp";
        const auto file = test::shared_file(name);
        if (!file) GTEST_SKIP() << test::needs_shared_file(name);
        scene_ = load(file->string()).value();
    }
    Scene scene_;
};

TEST_P(TreeMap, KeepsThePromisesOfAScene) {
    EXPECT_GT(scene_.triangles.size(), 300U);
    EXPECT_GT(scene_.brushes.size(), 50U);
    EXPECT_GE(scene_.spawn_points.size(), 1U);
    for (const auto& [a, b, c] : scene_.triangles) {
        ASSERT_LT(std::max({a, b, c}), scene_.vertices.size());
    }
    for (const SpawnPoint& spawn : scene_.spawn_points) {
        EXPECT_GT(test::clearance(scene_, spawn.eye), 4.0) << spawn.kind << ' ' << spawn.eye.transpose();
    }
}

TEST_P(TreeMap, BotsWalkInFreeSpace) {
    const std::string name = "maps/" + GetParam() + ".way";
    const auto file = test::shared_file(name);
    if (!file) GTEST_SKIP() << test::needs_shared_file(name);
    const std::vector<Vec3d> points = test::way_points(*file);
    ASSERT_GT(points.size(), 10U);
    for (const Vec3d& point : points) {
        EXPECT_LE(test::depth_in_solid(scene_, point), 0.0) << point.transpose() << ": on a floor at most";
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, TreeMap,
                         testing::Values("4all", "bunker-defense", "corner", "dung3on", "fegefeuer",
                                         "lexi_temple", "loop", "nzp_warehouse", "lqdm1", "lqdm13"),
                         [](const auto& test) {
                             std::string name = test.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

INSTANTIATE_TEST_SUITE_P(OpenArena, RealMap, testing::ValuesIn(test::traced_maps()));

}  // namespace
}  // namespace camdir::scene
