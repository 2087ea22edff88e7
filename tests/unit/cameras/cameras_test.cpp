// Other people's cameras in rooms of boxes, whose walls stop them at known places.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench/cameras/chase.hpp"
#include "bench/cameras/spots.hpp"
#include "bench/cameras/spring_arm.hpp"
#include "oracle/oracle.hpp"
#include "unit/evaluation/box_scene.hpp"

namespace camdir::bench {
namespace {

using evaluation::CameraSample;
using evaluation::TracePose;

constexpr double unit = 1.0;
constexpr double tolerance = 0.1;  // Bullet's margin, and floats

TracePose looking(double yaw_degrees, const Vec3d& eye, bool discontinuity = false) {
    TracePose pose;
    pose.eye = eye;
    pose.orientation = quake_orientation(0.0, yaw_degrees, 0.0);
    pose.view_height = 26.0F;
    pose.discontinuity = discontinuity;
    return pose;
}

// Free for |x|, |y| < 400 and 0 < z < 300.
class Cameras : public testing::Test {
  protected:
    [[nodiscard]] std::vector<Camera> all() const {
        return {swept_arm(bullet_, 0.0, unit), swept_arm(bullet_, 10.0, unit), ray_arm(embree_, unit),
                hltv_chase(bullet_, unit), best_of_spots(embree_, unit)};
    }

    scene::Scene scene_ = evaluation::room();
    BulletQueries bullet_{scene_};
    EmbreeQueries embree_{scene_};
};

TEST_F(Cameras, StandBehindThePlayerWhereThereIsRoom) {
    for (const Camera& camera : all()) {
        SCOPED_TRACE(camera.name);
        const Follow follow = camera.make();
        const CameraSample first = follow(looking(90, {0, 0, 100}, true), 0.0);
        EXPECT_TRUE(first.cut);
        EXPECT_LT((first.position - Vec3d(0, -120, 100)).norm(), tolerance);
        EXPECT_LT(first.orientation.angularDistance(quake_orientation(0, 90, 0)), 1e-6);
        const CameraSample second = follow(looking(90, {0, 0, 100}), 0.016);
        EXPECT_FALSE(second.cut);
        EXPECT_LT((second.position - first.position).norm(), tolerance);
    }
}

// Wherever a player turns and runs in the room, the camera sees the eye from inside.
TEST_F(Cameras, NeverLeaveTheRoom) {
    const oracle::Oracle oracle(scene_);
    for (const Camera& camera : all()) {
        SCOPED_TRACE(camera.name);
        const Follow follow = camera.make();
        for (int i = 0; i < 600; ++i) {
            const Vec3d eye(370.0 * std::sin(0.013 * i), 370.0 * std::cos(0.017 * i), 60.0);
            const CameraSample sample = follow(looking(4.0 * i, eye, i == 0), 0.016);
            ASSERT_TRUE(oracle.segment_clear(sample.position, eye)) << i;
        }
    }
}

TEST_F(Cameras, AreOfThePlayerWhomTheyWereMadeFor) {
    for (const Camera& camera : all()) {
        SCOPED_TRACE(camera.name);
        const Follow one = camera.make();
        const Follow other = camera.make();
        (void)one(looking(0, {0, 0, 100}, true), 0.0);
        (void)other(looking(180, {100, 0, 100}, true), 0.0);
        EXPECT_LT((one(looking(0, {0, 0, 100}), 0.016).position - Vec3d(-120, 0, 100)).norm(), tolerance);
    }
}

TEST_F(Cameras, ASweptSphereStopsAtItsRadiusFromTheWall) {
    const Follow follow = swept_arm(bullet_, 0.0, unit).make();
    const CameraSample sample = follow(looking(0, {-350, 0, 100}, true), 0.0);
    EXPECT_NEAR(sample.position.x(), -388.0, tolerance);
    // At once back when the wall is behind another side.
    EXPECT_NEAR(follow(looking(180, {-350, 0, 100}), 0.016).position.x(), -230.0, tolerance);
}

TEST_F(Cameras, ALaggingArmIsATenthOfASecondBehind) {
    const Follow follow = swept_arm(bullet_, 10.0, unit).make();
    CameraSample sample = follow(looking(0, {-100, 0, 100}, true), 0.0);
    for (int i = 1; i <= 100; ++i)
        sample = follow(looking(0, {-100.0 + 3.0 * i, 0, 100}), 0.01);
    // In the limit the arm's origin falls back by (1/0.1 - 1) steps of 3 units.
    EXPECT_NEAR(sample.position.x(), 200.0 - 27.0 - 120.0, tolerance);
}

TEST_F(Cameras, ARayArmShortensAtOnceAndEasesBack) {
    const Follow follow = ray_arm(embree_, unit).make();
    const double pulled =
        (follow(looking(0, {-350, 0, 100}, true), 0.0).position - Vec3d(-350, 0, 100)).norm();
    EXPECT_LT(pulled, 50.0);
    double before = pulled;
    for (int i = 0; i < 100; ++i) {
        const double now =
            (follow(looking(180, {-350, 0, 100}), 0.016).position - Vec3d(-350, 0, 100)).norm();
        EXPECT_GE(now, before);
        EXPECT_LT(now - before, 20.0);
        before = now;
    }
    EXPECT_NEAR(before, 120.0, 1.0);
    EXPECT_NEAR((follow(looking(0, {-350, 0, 100}), 0.016).position - Vec3d(-350, 0, 100)).norm(), pulled,
                1e-3);
}

TEST_F(Cameras, HltvTurnsAt180DegreesASecondAndRecovers32UnitsASecond) {
    const Follow follow = hltv_chase(bullet_, unit).make();
    (void)follow(looking(0, {0, 0, 100}, true), 0.0);
    const CameraSample turned = follow(looking(90, {0, 0, 100}), 0.1);
    EXPECT_LT(turned.orientation.angularDistance(quake_orientation(0, 18, 0)), 1e-6);

    const Follow pulled = hltv_chase(bullet_, unit).make();
    const double near = -350.0 - pulled(looking(0, {-350, 0, 100}, true), 0.0).position.x();
    EXPECT_NEAR(near, 44.0, tolerance);
    EXPECT_NEAR(-300.0 - pulled(looking(0, {-300, 0, 100}), 0.25).position.x(), near + 8.0, tolerance);
}

TEST_F(Cameras, TheBestSpotIsBesideThePlayerWhereTheWallIsBehind) {
    const Follow follow = best_of_spots(embree_, unit).make();
    const Vec3d eye(-380, 0, 100);
    const CameraSample sample = follow(looking(0, eye, true), 0.0);
    EXPECT_GE((sample.position - eye).norm(), 60.0);
    const Vec3d forward = sample.orientation * Vec3d::UnitX();
    EXPECT_LT((forward - (eye - sample.position).normalized()).norm(), 1e-6) << "looks at the eye";
}

}  // namespace
}  // namespace camdir::bench
