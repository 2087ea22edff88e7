#include "evaluation/motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "evaluation/statistics.hpp"

namespace camdir::evaluation {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

constexpr double tolerance = 1e-9;
constexpr std::int64_t second = 1'000'000'000;

CameraSample at(double x, double yaw_degrees = 0.0) {
    return {Vec3d(x, 0, 0), quake_orientation(0, yaw_degrees, 0), false};
}

// x = 0, 1, 4, 10 at t = 0, 1, 2, 4: v = 1, 3, 3; a = 2/1, 0/1.5; jerk = 2 / ((2 + 2*1 + 1) / 4).
TEST(Motion, UnevenStepsByHand) {
    MotionSamples samples;
    MotionMeter meter(samples);
    meter.add(0 * second, at(0));
    meter.add(1 * second, at(1));
    meter.add(2 * second, at(4));
    meter.add(4 * second, at(10));
    EXPECT_THAT(samples.acceleration, ElementsAre(2.0, 0.0));
    EXPECT_THAT(samples.jerk, ElementsAre(DoubleNear(2.0 / 1.25, tolerance)));
}

// Yaw 170, 180, 200, 200: 10, 20, 0 degrees a second, through the wrap of the angle.
TEST(Motion, TurnsByHand) {
    MotionSamples samples;
    MotionMeter meter(samples);
    meter.add(0 * second, at(0, 170));
    meter.add(1 * second, at(0, 180));
    meter.add(2 * second, at(0, -160));
    meter.add(3 * second, at(0, 200));
    EXPECT_THAT(samples.angular_speed,
                ElementsAre(DoubleNear(10, tolerance), DoubleNear(20, tolerance), DoubleNear(0, tolerance)));
    EXPECT_THAT(samples.angular_acceleration,
                ElementsAre(DoubleNear(10, tolerance), DoubleNear(20, tolerance)));
    EXPECT_NEAR(samples.largest_rotation, 20.0, tolerance);
}

TEST(Motion, OppositeQuaternionsAreTheSameOrientation) {
    MotionSamples samples;
    MotionMeter meter(samples);
    CameraSample turned = at(0, 90);
    meter.add(0 * second, turned);
    turned.orientation.coeffs() *= -1.0;
    meter.add(1 * second, turned);
    EXPECT_THAT(samples.angular_speed, ElementsAre(DoubleNear(0, tolerance)));
}

TEST(Motion, SegmentsDoNotMix) {
    MotionSamples samples;
    MotionMeter meter(samples);
    meter.add(0 * second, at(0));
    meter.add(1 * second, at(1));
    meter.end_segment();
    meter.add(2 * second, at(1000, 90));
    meter.add(3 * second, at(1001, 90));
    meter.add(4 * second, at(1002, 90));
    EXPECT_THAT(samples.acceleration, ElementsAre(0.0));
    EXPECT_EQ(samples.angular_speed.size(), 3U);
    EXPECT_NEAR(samples.largest_rotation, 0.0, tolerance);
}

TEST(Statistics, ByHand) {
    EXPECT_TRUE(std::isnan(mean({})));
    EXPECT_TRUE(std::isnan(root_mean_square({})));
    EXPECT_TRUE(std::isnan(percentile({}, 0.95)));
    const std::vector<double> values{4, 1, 3, 2};
    EXPECT_EQ(mean(values), 2.5);
    EXPECT_EQ(root_mean_square(values), std::sqrt(7.5));
    EXPECT_EQ(percentile(values, 0.0), 1.0);
    EXPECT_EQ(percentile(values, 0.5), 3.0);
    EXPECT_EQ(percentile(values, 0.74), 3.0);
    EXPECT_EQ(percentile(values, 1.0), 4.0);
}

}  // namespace
}  // namespace camdir::evaluation
