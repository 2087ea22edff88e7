#include "bake/forecast.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bake/bake.hpp"
#include "bake/sample_estimate.hpp"
#include "scene/load.hpp"
#include "support/openarena.hpp"
#include "support/solid_scenes.hpp"
#include "unit/bake/counts.hpp"

namespace camdir::bake {
namespace {

// Forecast samples over those that the bake made.
double forecast_ratio(const scene::Scene& scene, const Parameters& parameters) {
    Forecast forecast;
    const auto baked = bake(scene, parameters, {}, {}, {}, [&](const Forecast& f) { forecast = f; });
    return forecast.samples / count_of(baked.value(), "weld", "samples");
}

TEST(Forecast, KnowsTheNumberOfSamplesOfARoom) {
    const test::SolidScene room = test::pillar_room();
    for (const double d0 : {2.0, 4.0, 8.0, 16.0})
        for (const Sampling sampling : {Sampling::adaptive, Sampling::uniform}) {
            Parameters parameters;
            parameters.d0 = d0;
            parameters.loss = 0.0;
            parameters.sampling = sampling;
            const double ratio = forecast_ratio(room.scene(), parameters);
            EXPECT_GT(ratio, 0.8) << "d0 " << d0 << ", " << name_of(sampling);
            EXPECT_LT(ratio, 1.25) << "d0 " << d0 << ", " << name_of(sampling);
        }
}

TEST(Forecast, KnowsTheNumberOfSamplesOfARealMap) {
    const auto map = test::openarena_map("oa_dm1");
    if (!map) GTEST_SKIP() << "needs OpenArena's maps";
    const auto scene = scene::load(*map).value();
    for (const double d0 : {16.0, 32.0}) {
        Parameters parameters;
        parameters.d0 = d0;
        parameters.loss = 0.0;
        const double ratio = forecast_ratio(scene, parameters);
        EXPECT_GT(ratio, 0.9) << "d0 " << d0;
        EXPECT_LT(ratio, 1.1) << "d0 " << d0;
    }
}

TEST(Forecast, CostGrowsWithSamplesAndShrinksWithThreads) {
    const auto of = [](double points, unsigned threads) {
        return forecast(SampleEstimate(points, 16.0), 16.0, 1.0, threads);
    };
    EXPECT_LT(of(1e5, 2).seconds, of(1e6, 2).seconds);
    EXPECT_LT(of(1e5, 2).memory, of(1e6, 2).memory);
    EXPECT_GT(of(1e6, 1).seconds, of(1e6, 2).seconds);
    EXPECT_GT(of(1e6, 2).seconds, of(1e6, 64).seconds);
}

TEST(Forecast, NamesTheD0OfAMinutesWorkWhereItIsNeeded) {
    const SampleEstimate small(1e5, 16.0);
    EXPECT_EQ(forecast(small, 16.0, 1.0, 2).quick_d0, 0.0);
    const SampleEstimate large(1e7, 16.0);
    const Forecast expected = forecast(large, 16.0, 1.0, 2);
    EXPECT_GT(expected.seconds, 60.0);
    ASSERT_GT(expected.quick_d0, 16.0);
    EXPECT_LE(forecast(large, expected.quick_d0, 1.0, 2).seconds, 60.0);
    EXPECT_GT(forecast(large, 0.75 * expected.quick_d0, 1.0, 2).seconds, 60.0);
    EXPECT_EQ(forecast(large, expected.quick_d0, 1.0, 2).memory, expected.quick_memory);
    // The same map in metres.
    const Forecast in_metres = forecast(SampleEstimate(1e7, 16.0 * 0.0254), 16.0 * 0.0254, 0.0254, 2);
    EXPECT_EQ(in_metres.quick_d0, expected.quick_d0);
}

TEST(Forecast, RefusalNamesAD0ThatFitsIntoTheMemory) {
    // With 64 threads, a bake of one minute takes more than 3 GB.
    const SampleEstimate large(1e7, 16.0);
    const Forecast expected = forecast(large, 16.0, 1.0, 64);
    ASSERT_GT(expected.quick_memory, 3'000'000'000U);
    const auto refused = check_memory(expected, large, 16.0, 1.0, 1'000'000'000, "made.map");
    ASSERT_FALSE(refused);
    EXPECT_THAT(
        refused.error().message,
        testing::AllOf(testing::StartsWith("made.map: a bake with d0 = 16 is expected to take 11.5 GB"),
                       testing::HasSubstr("the limit is 1.0 GB; d0 = 60 would take 841 MB")));
    EXPECT_TRUE(check_memory(forecast(large, 60.0, 1.0, 64), large, 60.0, 1.0, 1'000'000'000, "made.map"));
    // Also when the bake is quick.
    const SampleEstimate small(1e5, 16.0);
    const Forecast quick = forecast(small, 16.0, 1.0, 64);
    EXPECT_THAT(check_memory(quick, small, 16.0, 1.0, 100'000'000, "made.map").error().message,
                testing::HasSubstr("the limit is 100 MB; d0 = 20 would take 97 MB"));
    EXPECT_THAT(
        check_memory(quick, small, 16.0, 1.0, 1'000'000, "made.map").error().message,
        testing::HasSubstr("the limit is 1 MB; no d0 up to 256 would fit: allow the bake more memory"));
}

TEST(Forecast, ABakeThatNeedsMoreMemoryThanItMayHaveIsRefused) {
    const test::SolidScene room = test::pillar_room();
    Parameters parameters;
    parameters.memory = 1'000'000;
    bool sampled = false;
    const auto progress = [&](const Progress& p) { sampled = sampled || p.stage == "sample"; };
    const auto refused = bake(room.scene(), parameters, progress, {});
    ASSERT_FALSE(refused);
    EXPECT_FALSE(sampled);
    EXPECT_THAT(refused.error().message,
                testing::AllOf(testing::HasSubstr("d0 = 16 is expected to take"),
                               testing::HasSubstr("the limit is"), testing::HasSubstr("--memory")));
    parameters.memory = 1'000'000'000;
    EXPECT_TRUE(bake(room.scene(), parameters, {}, {}));
}

}  // namespace
}  // namespace camdir::bake
