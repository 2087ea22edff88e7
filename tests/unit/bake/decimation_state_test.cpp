#include "bake/reduction/decimation_state.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace camdir::bake {
namespace {

TEST(FindCoveringSlab, IsTheBestOfAllSlabsAndGivesNoMoreThanThereIs) {
    std::mt19937 random(19);
    std::uniform_real_distribution<float> coordinate(-100.0F, 100.0F);
    std::uniform_real_distribution<float> distance(-10.0F, 60.0F);
    for (int round = 0; round < 2000; ++round) {
        std::vector<freespace::Vertex> vertices;
        for (int i = 0; i < 12; ++i)
            vertices.push_back(
                {4000.0F + coordinate(random), coordinate(random), coordinate(random), distance(random)});
        std::vector<freespace::Triangle> triangles;
        double best = -std::numeric_limits<double>::infinity();
        const Vec3d point(4000.0F + coordinate(random), coordinate(random), coordinate(random));
        const auto count = 1 + random() % 9;
        for (std::uint32_t i = 0; i < count; ++i) {
            triangles.push_back({i, i + 1, i + 2});
            const auto at = [&](std::uint32_t v) -> Vec3d { return vertices[v].position().cast<double>(); };
            const Slab of_one(
                {at(i), at(i + 1), at(i + 2)},
                {vertices[i].free_distance, vertices[i + 1].free_distance, vertices[i + 2].free_distance});
            best = std::max(best, of_one.distance(point));
        }
        const CoveringSlab slab = find_covering_slab(vertices, triangles, point);
        ASSERT_LT(slab.position, triangles.size()) << "round " << round;
        ASSERT_LE(slab.distance, best + 1e-9) << "round " << round;
        ASSERT_GE(slab.distance, best - 1e-2) << "round " << round;
    }
}

TEST(FindCoveringSlab, FindsNoneWithoutSlabs) {
    EXPECT_EQ(find_covering_slab({}, {}, Vec3d::Zero()).position, freespace::none);
}

// Two triangles far from each other, with a spawn point in the second.
TEST(DecimationState, DistancesAboveTheOffsetRadiusStayAboveIt) {
    const MedialMesh mesh{{{0, 0, 0}, {40, 0, 0}, {0, 40, 0}, {400, 0, 0}, {440, 0, 0}, {400, 40, 0}},
                          {{0, 1, 2}, {3, 4, 5}}};
    const std::vector<float> free_distance{17.0F, 16.0F, 90.0F, 40.0F, 40.0F, 40.0F};
    scene::Scene scene;
    scene.points = {Vec3d(0, 0, -1000)};
    scene.spawn_points.push_back({Vec3d(410, 10, 20), 0.0, "seed"});
    const Obstacles obstacles(scene);
    const Reduction reduction{.max_loss = 24.0, .offset_radius = 16.0};
    DecimationState state(mesh, free_distance, scene, obstacles, reduction);

    ASSERT_EQ(state.samples[1].size(), 4U);
    EXPECT_NEAR(state.samples[1].back().unreduced_distance, 20.0, 1e-4);
    EXPECT_NEAR(state.samples[1].back().min_distance, 18.0, 1e-4);
    EXPECT_EQ(state.samples[0].size(), 2U) << "a vertex without a ball is no sample";

    state.spend_slack(1.0);
    EXPECT_EQ(state.vertices[0].free_distance, 16.75F);
    EXPECT_EQ(state.vertices[1].free_distance, 16.0F);
    EXPECT_NEAR(state.vertices[2].free_distance, 90.0 - 0.3 * 24.0, 1e-4);
    EXPECT_EQ(state.vertices[3].free_distance, 40.0F) << "a spawn point needs it";
}

}  // namespace
}  // namespace camdir::bake
