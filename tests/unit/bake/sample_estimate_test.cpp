#include "bake/sample_estimate.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <random>

#include "bake/sample.hpp"
#include "bake/thin.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {
namespace {

double slack_of(const SamplingDistance& distance) {
    return distance.finest() / 64.0;
}

double sampled(const scene::Scene& scene, const SamplingDistance& distance) {
    const double slack = slack_of(distance);
    Stage stage("sample", {}, {});
    auto samples = sample(scene, Solids(scene), distance, slack, stage).value();
    return static_cast<double>(thin(std::move(samples), slack, stage).value().size());
}

SampleEstimate estimate(const scene::Scene& scene, const SamplingDistance& distance) {
    return {scene, Solids(scene), distance, slack_of(distance)};
}

double ratio(const scene::Scene& scene, const SamplingDistance& distance) {
    return estimate(scene, distance).samples(distance.finest()) / sampled(scene, distance);
}

// Of the cube up to 400 units from the origin in each axis.
Vec3d random_point(std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-400.0, 400.0);
    const double x = coordinate(random);
    const double y = coordinate(random);
    return {x, y, coordinate(random)};
}

// From 4 to 32, least near random points.
SamplingDistance random_distance(std::mt19937& random) {
    std::vector<Vec3d> medial_axis;
    for (int i = 0; i < 60; ++i)
        medial_axis.push_back(random_point(random));
    return {4.0, 32.0, medial_axis};
}

// Large and small triangles, every third one a needle, none with a common edge.
scene::Scene random_soup(std::mt19937& random) {
    scene::Scene scene;
    for (std::uint32_t i = 0; i < 60; ++i) {
        const double size = i % 2 == 0 ? 1.0 : 0.1;
        const Vec3d centre = random_point(random);
        for (int corner = 0; corner < 3; ++corner)
            scene.vertices.emplace_back(centre + size * random_point(random));
        if (i % 3 == 0) scene.vertices.back() = scene.vertices[3 * i] + Vec3d(0.0, 1.0, 2.0);
        scene.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return scene;
}

// An open height field with a vertex every 8 units: most triangles need few samples or none.
scene::Scene random_terrain(std::mt19937& random) {
    constexpr std::uint32_t side = 101;
    std::uniform_real_distribution<double> roughness(-3.0, 3.0);
    scene::Scene scene;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x)
            scene.vertices.emplace_back(8.0 * x - 400.0, 8.0 * y - 400.0,
                                        60.0 * std::sin(0.1 * x) * std::cos(0.07 * y) + roughness(random));
    for (std::uint32_t y = 0; y + 1 < side; ++y)
        for (std::uint32_t x = 0; x + 1 < side; ++x) {
            const std::uint32_t corner = y * side + x;
            scene.triangles.push_back({corner, corner + 1, corner + side});
            scene.triangles.push_back({corner + 1, corner + side + 1, corner + side});
        }
    return scene;
}

TEST(SampleEstimate, IsUnbiasedOnRandomTriangles) {
    std::mt19937 random(1);
    constexpr int rounds = 20;
    double sum = 0.0;
    for (int round = 0; round < rounds; ++round) {
        const scene::Scene soup = random_soup(random);
        const double of_round = ratio(soup, random_distance(random));
        EXPECT_NEAR(of_round, 1.0, 0.15) << "round " << round;
        sum += of_round;
    }
    EXPECT_NEAR(sum / rounds, 1.0, 0.05);
}

TEST(SampleEstimate, IsUnbiasedOnOpenTerrain) {
    std::mt19937 random(2);
    const scene::Scene terrain = random_terrain(random);
    for (const double d0 : {1.0, 2.0, 4.0})
        EXPECT_NEAR(ratio(terrain, SamplingDistance(d0)), 1.0, 0.1) << "d0 " << d0;
    for (int round = 0; round < 5; ++round)
        EXPECT_NEAR(ratio(terrain, random_distance(random)), 1.0, 0.1) << "round " << round;
}

TEST(SampleEstimate, KnowsWhatIsBuried) {
    const test::SolidScene room = test::pillar_room();
    for (const double d0 : {2.0, 4.0})
        EXPECT_NEAR(ratio(room.scene(), SamplingDistance(d0)), 1.0, 0.15) << "d0 " << d0;
}

TEST(SampleEstimate, HoldsForLargerDistances) {
    std::mt19937 random(3);
    const scene::Scene soup = random_soup(random);
    const SampleEstimate fine = estimate(soup, SamplingDistance(2.0));
    for (const double d0 : {3.0, 4.0, 8.0, 16.0})
        EXPECT_NEAR(fine.samples(d0) / sampled(soup, SamplingDistance(d0)), 1.0, 0.15) << "d0 " << d0;
}

TEST(SampleEstimate, IsTheSameForAnyNumberOfThreads) {
    std::mt19937 random(4);
    const scene::Scene soup = random_soup(random);
    const SamplingDistance distance = random_distance(random);
    const auto with = [&](int threads) {
        return tbb::task_arena(threads).execute([&] { return estimate(soup, distance); });
    };
    const SampleEstimate one = with(1);
    const SampleEstimate two = with(2);
    for (const double d0 : {4.0, 5.0, 10.0, 40.0})
        EXPECT_EQ(one.samples(d0), two.samples(d0)) << "d0 " << d0;
}

TEST(SampleEstimate, OfASceneWithoutTrianglesIsZero) {
    const scene::Scene empty;
    EXPECT_EQ(estimate(empty, SamplingDistance(4.0)).samples(4.0), 0.0);
}

}  // namespace
}  // namespace camdir::bake
