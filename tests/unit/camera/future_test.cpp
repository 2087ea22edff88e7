// Known poses are read, unknown ones are predicted.
#include "camera/future.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "walk.hpp"

namespace camdir::camera {
namespace {

constexpr double frame_time = 0.016;

std::vector<TimedPose> motion(const Vec3f& from, const Vec3f& velocity, float yaw_rate, int poses) {
    std::vector<TimedPose> list;
    for (int i = 0; i < poses; ++i) {
        const auto seconds = static_cast<float>(i * frame_time);
        Pose pose = pose_at(from + seconds * velocity, wrapped(yaw_rate * seconds));
        pose.velocity = velocity;
        list.push_back({i * frame_time, pose, true});
    }
    return list;
}

class FutureOfAPlayer : public testing::Test {
  protected:
    const Future& foreseen(const std::vector<TimedPose>& poses, double start, float yaw = 0.0F) {
        foresee(freespace_, profile_, poses, start, frame_time, 2.5, yaw, balls_, *future_);
        return *future_;
    }

    test::Plan plan_ = test::figure_eight();
    freespace::Freespace freespace_ = plan_.freespace();
    MapProfile profile_{Profile{}, 0.0254F};
    freespace::RecentBalls balls_;
    std::unique_ptr<Future> future_ = std::make_unique<Future>();
    Vec3f open_ = plan_.eye(6, 7);
};

TEST_F(FutureOfAPlayer, IsReadWhereItIsKnown) {
    const auto poses = motion(open_, Vec3f(50.0F, 20.0F, 0.0F), 4.0F, 101);
    const Future& future = foreseen(poses, 20 * frame_time);
    ASSERT_EQ(future.known, 81U);
    for (std::size_t i = 0; i < future.known; ++i) {
        const TimedPose& pose = poses[20 + i];
        EXPECT_LT((future[i].eye - pose.pose.eye).norm(), 1e-3F);
        EXPECT_NEAR(future[i].view.yaw, 4.0F * static_cast<float>(pose.time), 1e-3F) << "without jumps";
    }
}

TEST_F(FutureOfAPlayer, IsInterpolatedBetweenSlowPoses) {
    auto poses = motion(open_, Vec3f(60.0F, 0.0F, 0.0F), 1.0F, 41);
    std::erase_if(poses, [](const TimedPose& each) { return std::lround(each.time / frame_time) % 4 != 0; });
    const Future& future = foreseen(poses, 1.5 * frame_time);
    for (std::size_t i = 0; i < future.known; ++i) {
        const double time = (1.5 + static_cast<double>(i)) * frame_time;
        EXPECT_NEAR(future[i].eye.x(), open_.x() + 60.0F * static_cast<float>(time), 1e-2F);
        EXPECT_NEAR(future[i].view.yaw, static_cast<float>(time), 1e-3F);
    }
}

TEST_F(FutureOfAPlayer, FadesFromTheVelocityOfTheLastPoses) {
    const auto poses = motion(open_, Vec3f(40.0F, 0.0F, 0.0F), 0.0F, 11);
    const Future& future = foreseen(poses, 10 * frame_time);
    EXPECT_EQ(future.known, 1U);
    ASSERT_GE(static_cast<double>(future.count - 1) * frame_time, 0.38);
    const Vec3f last = poses.back().pose.eye;
    for (std::size_t i = 1; i < future.count; ++i) {
        const auto seconds = static_cast<float>(static_cast<double>(i) * frame_time);
        EXPECT_NEAR(future[i].eye.x() - last.x(), 40.0F * 0.5F * (1.0F - std::exp(-seconds / 0.5F)), 0.05F);
        EXPECT_NEAR(future[i].eye.y(), last.y(), 1e-3F);
    }
}

TEST_F(FutureOfAPlayer, TurnsOnALittleAndHardlyWhenTheTurnSlowsDown) {
    auto poses = motion(open_, Vec3f::Zero(), 5.0F, 11);
    const Future& constant = foreseen(poses, 10 * frame_time, 0.8F);
    const float turned = constant[constant.count - 1].view.yaw - 0.8F;
    EXPECT_NEAR(turned, 5.0F * 0.1F, 0.02F);
    poses.back().pose.orientation = pose_at(open_, 0.72F + 0.04F).orientation;
    const Future& ending = foreseen(poses, 10 * frame_time, 0.76F);
    EXPECT_NEAR(ending[ending.count - 1].view.yaw, 0.76F + 0.04F / 0.016F * 0.02F, 0.01F);
}

TEST_F(FutureOfAPlayer, StopsBeforeAWall) {
    const Vec3f velocity(0.0F, 1200.0F, 0.0F);
    Vec3f from = open_;
    while (plan_.clearance(from + Vec3f(0.0F, 200.0F, 0.0F)) > 0.0F)
        from.y() += 10.0F;
    const auto poses = motion(from - 0.16F * velocity, velocity, 0.0F, 11);
    const Future& future = foreseen(poses, 10 * frame_time);
    for (std::size_t i = 0; i < future.count; ++i)
        EXPECT_GT(plan_.clearance(future[i].eye), 0.0F);
}

TEST_F(FutureOfAPlayer, EndsWhereThePlayerDiesOrJumps) {
    for (const bool jump : {false, true}) {
        auto poses = motion(open_, Vec3f(50.0F, 0.0F, 0.0F), 0.0F, 101);
        if (jump)
            poses[50].pose.discontinuity = true;
        else
            poses[50].pose.alive = false;
        const Future& future = foreseen(poses, 20 * frame_time);
        EXPECT_EQ(future.known, 30U);
        EXPECT_GT(future.count, future.known);
    }
}

}  // namespace
}  // namespace camdir::camera
