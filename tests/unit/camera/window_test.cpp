#include "camera/window.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "walk.hpp"

namespace camdir::camera {
namespace {

// Five poses, a second apart, along the x axis.
std::vector<TimedPose> five() {
    std::vector<TimedPose> poses;
    for (int i = 0; i < 5; ++i)
        poses.push_back(
            {static_cast<double>(i), pose_at(Vec3f(10.0F * static_cast<float>(i), 0.0F, 0.0F), 0.0F), true});
    return poses;
}

TEST(Window, InterpolatesWithinAStretch) {
    const auto poses = five();
    EXPECT_FALSE(pose_at(poses, 0.0, -0.5));
    EXPECT_EQ(pose_at(poses, 0.0, 2.0)->eye.x(), 20.0F);
    EXPECT_FLOAT_EQ(pose_at(poses, 0.0, 2.25)->eye.x(), 22.5F);
    EXPECT_EQ(pose_at(poses, 0.0, 9.0)->eye.x(), 40.0F) << "the last one, however old";
}

TEST(Window, KeepsTheEarlierPoseAcrossABreak) {
    for (int what = 0; what < 4; ++what) {
        auto poses = five();
        if (what == 0) poses[3].pose.discontinuity = true;
        if (what == 1) poses[3].pose.alive = false;
        if (what == 2) poses[3].present = false;
        if (what == 3) poses[3].pose.eye.y() = std::numeric_limits<float>::quiet_NaN();
        EXPECT_EQ(pose_at(poses, 0.0, 2.75)->eye.x(), 20.0F) << what;
        EXPECT_EQ(pose_at(poses, 0.0, 3.0).has_value(), what < 2) << what;
        EXPECT_FALSE(continuous(poses, 2)) << what;
        EXPECT_TRUE(continuous(poses, 1)) << what;
    }
}

TEST(Window, ReportsAJumpOnceEvenIfItsPoseWasSkipped) {
    auto poses = five();
    poses[2].pose.discontinuity = true;
    EXPECT_FALSE(pose_at(poses, 0.5, 1.5)->discontinuity);
    EXPECT_TRUE(pose_at(poses, 1.5, 3.5)->discontinuity);
    EXPECT_FALSE(pose_at(poses, 3.5, 3.75)->discontinuity);
}

TEST(Window, AVelocityIsLimitedByThePlayersSizeNotByTheMapsUnit) {
    EXPECT_EQ(plausible({300.0F, 0.0F, -400.0F}, 1.0F), Vec3f(300.0F, 0.0F, -400.0F));
    EXPECT_TRUE(plausible({0.0F, 3e4F, 4e4F}, 1.0F).isApprox(Vec3f(0.0F, 6e3F, 8e3F)));
    EXPECT_TRUE(plausible({0.0F, 300.0F, 400.0F}, 0.0254F).isApprox(Vec3f(0.0F, 152.4F, 203.2F))) << "metres";
    EXPECT_EQ(plausible(Vec3f::Constant(3e38F), 1.0F), Vec3f(Vec3f::Zero()));
}

TEST(Window, RecentPosesKeepTheLastOnes) {
    RecentPoses recent;
    EXPECT_TRUE(recent.window().empty());
    for (std::size_t i = 0; i < 200; ++i) {
        const Pose pose = pose_at(Vec3f(static_cast<float>(i), 0.0F, 0.0F), 0.0F);
        recent.add(static_cast<double>(i), i == 40 ? nullptr : &pose);
        const Window window = recent.window();
        ASSERT_GE(window.size(), std::min<std::size_t>(i + 1, 49));
        for (std::size_t k = 0; k < window.size(); ++k) {
            const std::size_t number = i + 1 + k - window.size();
            EXPECT_EQ(window[k].time, static_cast<double>(number));
            EXPECT_EQ(window[k].present, number != 40);
            EXPECT_EQ(window[k].pose.eye.x(), number != 40 ? static_cast<float>(number) : 0.0F);
        }
    }
}

}  // namespace
}  // namespace camdir::camera
