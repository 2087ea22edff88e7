#include "bench/paper/sampling.hpp"

#include <gtest/gtest.h>

#include "bake/bisection.hpp"

namespace camdir::paper {
namespace {

// An equilateral triangle of side 4.
scene::Scene triangle() {
    scene::Scene scene;
    scene.vertices = {{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {2.0, std::sqrt(12.0), 0.0}};
    scene.triangles = {{0, 1, 2}};
    return scene;
}

TEST(PaperSampling, SplitsEdgesOfTwiceTheDistance) {
    EXPECT_EQ(sample(triangle(), 2.001).value().size(), 3U);
    EXPECT_EQ(sample(triangle(), 1.999).value().size(), 6U);
    EXPECT_EQ(sample(triangle(), 1.001).value().size(), 6U);
    EXPECT_EQ(sample(triangle(), 0.999).value().size(), 15U);
}

TEST(PaperSampling, SplitsOneAndTwoLongEdges) {
    std::vector<Vec3d> samples;
    ASSERT_TRUE(split_long_edges({Vec3d(0, 0, 0), Vec3d(3, 0, 0), Vec3d(1.5, 1, 0)}, 1.0, samples));
    ASSERT_EQ(samples.size(), 1U);
    EXPECT_EQ(samples[0], Vec3d(1.5, 0, 0));

    samples.clear();
    ASSERT_TRUE(split_long_edges({Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0.5, 3, 0)}, 1.0, samples));
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_EQ(samples[0], Vec3d(0.75, 1.5, 0));
    EXPECT_EQ(samples[1], Vec3d(0.25, 1.5, 0));
}

// Why the project has another rule.
TEST(PaperSampling, MissesItsOwnSamplingCondition) {
    constexpr double d0 = 2.001;
    const auto samples = sample(triangle(), d0).value();
    ASSERT_EQ(samples.size(), 3U);
    EXPECT_GT(bake::covering_radius({samples[0], samples[1], samples[2]}), 1.15 * d0);
}

}  // namespace
}  // namespace camdir::paper
