#include "evaluation/motion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

// What was measured of all cameras.
class Samples {
  public:
    void add(std::int64_t time, const CameraSample& camera) {
        const Motion motion = meter_.add(time, camera);
        keep(motion.acceleration, acceleration);
        keep(motion.jerk, jerk);
        keep(motion.angular_speed, angular_speed);
        keep(motion.angular_acceleration, angular_acceleration);
        if (!std::isnan(motion.rotation)) largest_rotation = std::max(largest_rotation, motion.rotation);
        comfortable += motion.comfortable;
    }

    void end_segment() { meter_.end_segment(); }

    std::vector<double> acceleration, jerk, angular_speed, angular_acceleration;
    double largest_rotation = 0.0;
    std::size_t comfortable = 0;

  private:
    static void keep(double value, std::vector<double>& values) {
        if (!std::isnan(value)) values.push_back(value);
    }

    MotionMeter meter_;
};

// x = 0, 1, 4, 10 at t = 0, 1, 2, 4: v = 1, 3, 3; a = 2/1, 0/1.5; jerk = 2 / ((2 + 2*1 + 1) / 4).
TEST(Motion, UnevenStepsByHand) {
    Samples samples;
    samples.add(0 * second, at(0));
    samples.add(1 * second, at(1));
    samples.add(2 * second, at(4));
    samples.add(4 * second, at(10));
    EXPECT_THAT(samples.acceleration, ElementsAre(2.0, 0.0));
    EXPECT_THAT(samples.jerk, ElementsAre(DoubleNear(2.0 / 1.25, tolerance)));
}

// Yaw 170, 180, 200, 200: 10, 20, 0 degrees a second, through the wrap of the angle.
TEST(Motion, TurnsByHand) {
    Samples samples;
    samples.add(0 * second, at(0, 170));
    samples.add(1 * second, at(0, 180));
    samples.add(2 * second, at(0, -160));
    samples.add(3 * second, at(0, 200));
    EXPECT_THAT(samples.angular_speed,
                ElementsAre(DoubleNear(10, tolerance), DoubleNear(20, tolerance), DoubleNear(0, tolerance)));
    EXPECT_THAT(samples.angular_acceleration,
                ElementsAre(DoubleNear(10, tolerance), DoubleNear(20, tolerance)));
    EXPECT_NEAR(samples.largest_rotation, 20.0, tolerance);
}

TEST(Motion, OppositeQuaternionsAreTheSameOrientation) {
    Samples samples;
    CameraSample turned = at(0, 90);
    samples.add(0 * second, turned);
    turned.orientation.coeffs() *= -1.0;
    samples.add(1 * second, turned);
    EXPECT_THAT(samples.angular_speed, ElementsAre(DoubleNear(0, tolerance)));
}

TEST(Motion, SegmentsDoNotMix) {
    Samples samples;
    samples.add(0 * second, at(0));
    samples.add(1 * second, at(1));
    samples.end_segment();
    samples.add(2 * second, at(1000, 90));
    samples.add(3 * second, at(1001, 90));
    samples.add(4 * second, at(1002, 90));
    EXPECT_THAT(samples.acceleration, ElementsAre(0.0));
    EXPECT_EQ(samples.angular_speed.size(), 3U);
    EXPECT_NEAR(samples.largest_rotation, 0.0, tolerance);
}

// `turns` in degrees from frame to frame, of which there are 10 a second.
std::size_t comfortable(const std::vector<double>& turns) {
    Samples samples;
    double yaw = 0.0;
    samples.add(0, at(0));
    for (std::size_t i = 0; i < turns.size(); ++i)
        samples.add(static_cast<std::int64_t>(i + 1) * second / 10, at(0, yaw += turns[i]));
    return samples.comfortable;
}

// 1 radian a second is 57.3 degrees: half of the width of a view of 90 degrees.
TEST(Comfort, HasALimitOfSpeedAndOneOfSweep) {
    EXPECT_EQ(comfortable(std::vector(30, 5.7)), 30U);
    EXPECT_EQ(comfortable(std::vector(30, 5.8)), 0U);
    EXPECT_EQ(comfortable({0, 0, 0, 0, 11.9, 0}), 6U);
    EXPECT_EQ(comfortable({0, 0, 0, 0, 12.1, 0}), 5U);
}

// After 0.5 s of standing, the frames in which the last second has 57.3 degrees and more: the sixth turn of
// 10 degrees up to the frame before that in which only five of them are left.
TEST(Comfort, SweepIsTheMeanOfTheLastSecond) {
    std::vector<double> turns(5, 0.0);
    turns.insert(turns.end(), 6, 10.0);
    turns.insert(turns.end(), 20, 0.0);
    EXPECT_EQ(comfortable(turns), turns.size() - 5);
    EXPECT_EQ(comfortable({10, -10, 10, -10, 10, -10}), 0U) << "shaking is no rest";
}

TEST(Comfort, IgnoresRollAndTheWayInTheSweep) {
    Samples samples;
    for (int i = 0; i <= 20; ++i)
        samples.add(i * second / 10, {Vec3d(100.0 * i, 0, 0), quake_orientation(0, 0, 11.9 * i), false});
    EXPECT_EQ(samples.comfortable, 20U);
}

TEST(Comfort, BeginsAnewWithTheSegment) {
    Samples samples;
    for (int i = 0; i <= 5; ++i)
        samples.add(i * second / 10, at(0, 11.0 * i));
    EXPECT_EQ(samples.comfortable, 0U);
    samples.end_segment();
    samples.add(6 * second / 10, at(0, 180));
    samples.add(7 * second / 10, at(0, 180));
    EXPECT_EQ(samples.comfortable, 1U);
}

// Frames farther apart than the second that is looked at.
TEST(Comfort, OfRareFramesIsThatOfOneStep) {
    Samples samples;
    samples.add(0, at(0));
    samples.add(2 * second, at(0, 114));
    samples.add(4 * second, at(0, 230));
    EXPECT_EQ(samples.comfortable, 1U);
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
