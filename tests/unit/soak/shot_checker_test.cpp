// The findings of the observer probe, and its latencies.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "soak/latencies.hpp"
#include "soak/shot_checker.hpp"

namespace camdir::soak {
namespace {

// One wall: the square |y|, |z| <= 100 at x = 0.
scene::Scene wall() {
    scene::Scene scene;
    scene.vertices = {{0, -100, -100}, {0, 100, -100}, {0, 100, 100}, {0, -100, 100}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.bounds = Box3d(Vec3d(-500, -500, -500), Vec3d(500, 500, 500));
    return scene;
}

class ShotCheckerTest : public testing::Test {
  protected:
    // The next frame, with the observer's camera at x.
    void camera_at(float x, std::uint32_t flags = 0) {
        ++frame_.frame_number;
        camera_director::Camera camera{};
        camera.camera_id = 5;
        camera.position[0] = x;
        camera.flags = flags;
        checker_.check(frame_, &camera, frame_.source_time + 2'000'000);
    }
    void no_camera() {
        ++frame_.frame_number;
        checker_.check(frame_, nullptr, frame_.source_time + 2'000'000);
    }
    [[nodiscard]] const Findings& found() const { return checker_.findings(); }

    oracle::Oracle oracle_{wall()};
    ShotChecker checker_{&oracle_, {.step = 64.0, .clearance = 1.0}};
    camera_director::CameraFrame frame_ = cdir_camera_frame_default();
};

TEST_F(ShotCheckerTest, ASmoothCameraIsNoViolation) {
    for (int i = 0; i < 20; ++i)
        camera_at(-200.0F + 5.0F * static_cast<float>(i), CDIR_CAMERA_TARGET_VISIBLE);
    EXPECT_EQ(found().frames, 20U);
    EXPECT_EQ(found().cameras, 20U);
    EXPECT_EQ(found().visible, 20U);
    EXPECT_EQ(found().in_obstacle + found().through_geometry + found().jumps + found().gaps, 0U);
    EXPECT_NEAR(found().latency.percentile(0.5), 2e-3, 2e-5);
}

TEST_F(ShotCheckerTest, AStepThroughTheWallCountsUnlessItIsACut) {
    camera_at(-20.0F);
    camera_at(20.0F);
    EXPECT_EQ(found().through_geometry, 1U);
    camera_at(-20.0F, CDIR_CAMERA_CUT);
    EXPECT_EQ(found().through_geometry, 1U);
    EXPECT_EQ(found().cuts, 1U);
}

TEST_F(ShotCheckerTest, ALongStepCountsUnlessItIsACutOrFramesAreMissing) {
    camera_at(100.0F);
    camera_at(165.0F);
    EXPECT_EQ(found().jumps, 1U);
    camera_at(100.0F, CDIR_CAMERA_CUT);
    EXPECT_EQ(found().jumps, 1U);
    frame_.frame_number += 3;
    camera_at(400.0F);
    EXPECT_EQ(found().jumps, 1U);
    EXPECT_EQ(found().gaps, 3U);
    no_camera();
    camera_at(100.0F);
    EXPECT_EQ(found().jumps, 1U) << "there was no camera in between";
}

TEST_F(ShotCheckerTest, AStepOverSkippedPosesMayBeLonger) {
    camera_at(100.0F);
    frame_.pose_number += 3;
    camera_at(290.0F);
    EXPECT_EQ(found().jumps, 0U);
    frame_.pose_number += 3;
    camera_at(485.0F);
    EXPECT_EQ(found().jumps, 1U);
}

TEST_F(ShotCheckerTest, ACameraInTheWallCounts) {
    camera_at(-0.5F);
    EXPECT_EQ(found().in_obstacle, 1U);
    camera_at(-1.5F);
    EXPECT_EQ(found().in_obstacle, 1U);
}

TEST_F(ShotCheckerTest, OldFramesAndOtherDirectorsAreCounted) {
    camera_at(100.0F);
    frame_.frame_number -= 1;
    camera_at(100.0F);
    EXPECT_EQ(found().disorder, 1U);
    frame_.director_id = 9;
    frame_.frame_number = 0;
    camera_at(300.0F);
    EXPECT_EQ(found().hand_overs, 1U);
    frame_.epoch = 2;
    camera_at(100.0F);
    EXPECT_EQ(found().epochs, 1U);
    EXPECT_EQ(found().jumps, 0U);
}

TEST(ShotCheckerWithADelay, FramesThatLeaveEarlyCountAndTimesBeginWhenTheyAreDue) {
    ShotChecker checker(nullptr, {.delay = 3.0});
    camera_director::CameraFrame frame = cdir_camera_frame_default();
    frame.source_time = 1'000'000'000;
    frame.write_time = 4'001'000'000;
    checker.check(frame, nullptr, 4'002'000'000);
    EXPECT_EQ(checker.findings().early, 0U);
    EXPECT_NEAR(checker.findings().lateness.percentile(1.0), 1e-3, 1e-5);
    EXPECT_NEAR(checker.findings().latency.percentile(1.0), 2e-3, 2e-5);
    ++frame.frame_number;
    frame.write_time = 3'999'999'999;
    checker.check(frame, nullptr, 4'002'000'000);
    EXPECT_EQ(checker.findings().early, 1U);
}

TEST(Latencies, PercentilesAreRightToOnePercent) {
    std::mt19937 random(7);
    std::lognormal_distribution<double> draw(-6.0, 1.0);
    Latencies latencies, other;
    std::vector<double> all;
    for (int i = 0; i < 20000; ++i) {
        all.push_back(draw(random));
        (i % 2 == 0 ? latencies : other).add(all.back());
    }
    latencies.add(other);
    std::sort(all.begin(), all.end());
    EXPECT_EQ(latencies.count(), all.size());
    EXPECT_EQ(latencies.largest(), all.back());
    for (const double share : {0.01, 0.5, 0.99, 0.999, 1.0}) {
        const double exact = all[static_cast<std::size_t>(std::ceil(share * 20000)) - 1];
        EXPECT_NEAR(latencies.percentile(share), exact, 0.0101 * exact) << share;
    }
}

TEST(Latencies, ValuesOutOfRangeStillCount) {
    Latencies latencies;
    EXPECT_EQ(latencies.percentile(0.99), 0.0);
    latencies.add(-1.0);  // a clock was set back
    latencies.add(1e9);
    EXPECT_EQ(latencies.count(), 2U);
    EXPECT_GT(latencies.percentile(1.0), 800.0);
}

}  // namespace
}  // namespace camdir::soak
