#include "bake/shrinking.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace camdir::bake {
namespace {

TEST(FindHome, IsTheBestOfAllSlabsAndGivesNoMoreThanThereIs) {
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
            const Slab slab(
                {at(i), at(i + 1), at(i + 2)},
                {vertices[i].free_distance, vertices[i + 1].free_distance, vertices[i + 2].free_distance});
            best = std::max(best, slab.distance(point));
        }
        const Home home = find_home(vertices, triangles, point);
        ASSERT_LT(home.position, triangles.size()) << "round " << round;
        ASSERT_LE(home.distance, best + 1e-9) << "round " << round;
        ASSERT_GE(home.distance, best - 1e-2) << "round " << round;
    }
}

TEST(FindHome, FindsNoneWithoutSlabs) {
    EXPECT_EQ(find_home({}, {}, Vec3d::Zero()).position, freespace::none);
}

}  // namespace
}  // namespace camdir::bake
