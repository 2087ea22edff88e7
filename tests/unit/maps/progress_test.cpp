#include "maps/progress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "support/q3_maps.hpp"

namespace camdir::maps {
namespace {

TEST(StageWeights, SumToOne) {
    for (const auto stages : {surface_stages(), cloud_stages()}) {
        const double sum =
            std::accumulate(stages.begin(), stages.end(), 0.0,
                            [](double before, const StageWeight& entry) { return before + entry.weight; });
        EXPECT_NEAR(sum, 1.0, 1e-9);
    }
}

// The stages that a bake of the scene reports, in their order.
std::vector<std::string> stages_of_bake(const scene::Scene& scene, double d0) {
    std::vector<std::string> stages;
    const auto note = [&](const bake::Progress& progress) {
        if (stages.empty() || stages.back() != progress.stage) stages.emplace_back(progress.stage);
    };
    bake::Parameters parameters;
    parameters.d0 = d0;
    EXPECT_TRUE(bake::bake(scene, parameters, note, {}));
    return stages;
}

// The points of a room's walls, floor and ceiling.
scene::Scene room_cloud(int spacing) {
    scene::Scene cloud;
    for (int x = 0; x <= 256; x += spacing)
        for (int y = 0; y <= 192; y += spacing)
            for (int z = 0; z <= 128; z += spacing)
                if (x == 0 || x == 256 || y == 0 || y == 192 || z == 0 || z == 128)
                    cloud.points.emplace_back(x, y, z);
    cloud.point_spacing = 1.25 * spacing;  // to the nearest 8
    cloud.metres_per_unit = metres_of_nominal_unit;
    cloud.bounds = Box3d(Vec3d::Zero(), Vec3d(256.0, 192.0, 128.0));
    cloud.spawn_points.push_back({Vec3d(128.0, 96.0, 64.0), 0.0F, "test"});
    return cloud;
}

std::vector<std::string> names_of(std::span<const StageWeight> stages) {
    std::vector<std::string> names;
    for (const StageWeight& entry : stages)
        names.emplace_back(entry.stage);
    return names;
}

TEST(StageWeights, NameTheStagesOfABake) {
    auto bsp = test::room_map(Box3d(Vec3d(0.0, 0.0, 0.0), Vec3d(512.0, 384.0, 256.0)));
    test::add_spawn_point(bsp, Vec3d(256.0, 192.0, 40.0));
    EXPECT_EQ(stages_of_bake(test::scene_of(bsp), 64.0), names_of(surface_stages()));
}

TEST(StageWeights, NameTheStagesOfACloudsBake) {
    scene::Scene cloud = room_cloud(16);
    EXPECT_EQ(stages_of_bake(cloud, 0.0), names_of(cloud_stages()));
}

// A bake whose stages take `scale` times the seconds of their weights, with noise, and report as they do.
struct Played {
    double largest_fall = 0.0;   // of the fraction
    double largest_error = 0.0;  // of the remaining time after the first third, as a share of the whole
    double end = 0.0;            // the fraction before the last stage ends
};

Played play(std::span<const StageWeight> stages, double scale, double noise, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> exponent(-noise, noise);
    std::vector<double> seconds;
    for (const StageWeight& entry : stages)
        seconds.push_back(entry.weight * scale * std::exp(exponent(random)));
    const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
    BakeProgress progress;
    TimeEstimate estimate;
    Played played;
    double begin = 0.0;
    double before = 0.0;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        constexpr std::uint64_t steps = 40;
        for (std::uint64_t step = 0; step < steps; ++step) {
            const double now = begin + seconds[i] * static_cast<double>(step) / steps;
            progress.update({stages[i].stage, stages[i].one_pass ? step : step * 3 % steps, steps}, now);
            const double fraction = progress.fraction(now);
            estimate.update(fraction, now);
            played.largest_fall = std::max(played.largest_fall, before - fraction);
            before = fraction;
            if (const auto remaining = estimate.remaining(fraction, now); remaining && now > total / 3.0)
                played.largest_error =
                    std::max(played.largest_error, std::abs(*remaining - (total - now)) / total);
        }
        begin += seconds[i];
    }
    played.end = before;
    return played;
}

TEST(BakeProgress, FollowsABakeLikeThoseMeasured) {
    for (const auto stages : {surface_stages(), cloud_stages()}) {
        for (const double scale : {10.0, 600.0}) {
            const Played played = play(stages, scale, 0.0, 0);
            EXPECT_EQ(played.largest_fall, 0.0);
            EXPECT_LT(played.largest_error, 0.25);
            EXPECT_GT(played.end, 0.95);
        }
    }
}

TEST(BakeProgress, NeverFallsAndStaysNearForOtherBakes) {
    for (std::uint32_t seed = 0; seed < 50; ++seed) {
        const Played played = play(surface_stages(), 60.0, 0.4, seed);
        EXPECT_EQ(played.largest_fall, 0.0) << "seed " << seed;
        EXPECT_LT(played.largest_error, 0.5) << "seed " << seed;
        EXPECT_LE(played.end, 1.0) << "seed " << seed;
    }
}

TEST(BakeProgress, WaitsWithoutMoving) {
    BakeProgress progress;
    progress.update({"waiting for another bake", 0, 0}, 0.0);
    EXPECT_EQ(progress.fraction(100.0), 0.0);
    EXPECT_EQ(progress.stage(), "waiting for another bake");
    progress.update({surface_stages().front().stage, 0, 0}, 100.0);
    EXPECT_EQ(progress.fraction(101.0), 0.0);
}

TEST(TimeEstimate, SaysNothingBeforeItKnows) {
    TimeEstimate estimate;
    EXPECT_FALSE(estimate.remaining(0.0, 0.0));
    estimate.update(0.001, 10.0);
    EXPECT_FALSE(estimate.remaining(0.001, 10.0));
    estimate.update(0.1, 10.0);
    EXPECT_NEAR(estimate.remaining(0.1, 10.0).value(), 90.0, 1e-9);
}

TEST(TimeEstimate, ChangesLittleWhenTheFractionJumps) {
    TimeEstimate estimate;
    estimate.update(0.2, 10.0);
    const double before = estimate.remaining(0.2, 10.0).value();
    estimate.update(0.6, 10.25);
    const double after = estimate.remaining(0.6, 10.25).value();
    EXPECT_LT(after, before);
    EXPECT_GT(after, before * 0.85);
}

}  // namespace
}  // namespace camdir::maps
