#include "view_prediction.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace camdir::openarena {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double radians = 3.14159265358979323846 / 180.0;

double number_between(double least, double most) {
    return least + (most - least) * static_cast<double>(*rc::gen::inRange(0, 1000001)) / 1e6;
}

// Quake's axes: yaw about z, then pitch about y, then roll about x.
Quaterniond orientation_of(double pitch, double yaw, double roll) {
    return AngleAxisd(yaw * radians, Vector3d::UnitZ()) * AngleAxisd(pitch * radians, Vector3d::UnitY()) *
           AngleAxisd(roll * radians, Vector3d::UnitX());
}

Quaterniond orientation_of(const view& v) {
    return orientation_of(v.angles[0], v.angles[1], v.angles[2]);
}

Vector3d vector_of(const float* v) {
    return {v[0], v[1], v[2]};
}

void set(float* to, const Vector3d& from) {
    for (int i = 0; i < 3; ++i)
        to[i] = static_cast<float>(from[i]);
}

viewer_camera camera_at(std::int32_t time, const Vector3d& position, const Quaterniond& orientation) {
    viewer_camera camera{};
    camera.live = 1;
    camera.segment = 1;
    camera.level_time = time;
    camera.clearance = 1000.0F;
    set(camera.position, position);
    for (int i = 0; i < 4; ++i)
        camera.orientation[i] = static_cast<float>(orientation.coeffs()[i]);
    return camera;
}

player_pose player_at(const Vector3d& eye) {
    player_pose player{};
    player.in_game = player.alive = 1;
    player.viewheight = 26;
    set(player.origin, eye - Vector3d(0, 0, 26));
    return player;
}

Vector3d eye_of(const player_pose& player) {
    return vector_of(player.origin) + Vector3d(0, 0, player.viewheight);
}

Vector3d any_vector(double size) {
    return {number_between(-size, size), number_between(-size, size), number_between(-size, size)};
}

camera_motion any_motion(double max_pitch = 85) {
    camera_motion motion{};
    const std::int32_t step = *rc::gen::inRange(1, 100);
    const Vector3d position = any_vector(4000);
    for (int i = 0; i < 2; ++i) {
        const Quaterniond orientation = orientation_of(number_between(-max_pitch, max_pitch),
                                                       number_between(-180, 180), number_between(-20, 20));
        viewer_camera camera = camera_at(1000 + i * step, position + i * any_vector(60), orientation);
        camera.clearance = static_cast<float>(number_between(0, 200));
        camera_motion_take(&motion, &camera);
    }
    return motion;
}

Vector3d direction_in_picture(const view& v, const player_pose& player) {
    return (orientation_of(v).conjugate() * (eye_of(player) - vector_of(v.position))).normalized();
}

TEST(OpenArenaViewPrediction, ACameraIsShownAsItIsAtItsOwnTime) {
    rc::check([] {
        const double pitch = number_between(-89, 89), yaw = number_between(-179, 179);
        const double roll = number_between(-179, 179);
        const viewer_camera camera = camera_at(1000, any_vector(4000), orientation_of(pitch, yaw, roll));
        camera_motion motion{};
        RC_ASSERT(camera_motion_take(&motion, &camera));
        const view shown = predict_view(&motion, 1000, nullptr, nullptr);
        RC_ASSERT(vector_of(shown.position) == vector_of(camera.position));
        RC_ASSERT(std::abs(shown.angles[0] - pitch) < 0.02);
        RC_ASSERT(orientation_of(shown).angularDistance(orientation_of(pitch, yaw, roll)) < 1e-3);
    });
}

TEST(OpenArenaViewPrediction, NeverMovesBeyondTheClearance) {
    rc::check([] {
        const camera_motion motion = any_motion();
        const view shown =
            predict_view(&motion, motion.newest.level_time + *rc::gen::inRange(0, 300), nullptr, nullptr);
        const double moved = (vector_of(shown.position) - vector_of(motion.newest.position)).norm();
        RC_ASSERT(moved <= std::max(0.0, motion.newest.clearance - 1.0) + 1e-3);
    });
}

TEST(OpenArenaViewPrediction, TheTargetKeepsItsPlaceInThePicture) {
    rc::check([] {
        // Steeper, a turn by pitch and yaw alone cannot keep what is far off the centre.
        const camera_motion motion = any_motion(45);
        const view before = view_of_camera(&motion.newest);
        const Vector3d in_picture(1, number_between(-0.5, 0.5), number_between(-0.3, 0.3));
        const Vector3d ray = (orientation_of(before) * in_picture).normalized() * number_between(150, 1500);
        const player_pose then = player_at(vector_of(motion.newest.position) + ray);
        const player_pose now = player_at(eye_of(then) + any_vector(20));
        const std::int32_t step = motion.newest.level_time - motion.previous.level_time;
        const view after = predict_view(&motion, motion.newest.level_time + step / 2, &then, &now);
        RC_PRE((vector_of(after.position) - vector_of(before.position)).norm() < 40);
        const double error = std::acos(
            std::min(1.0, direction_in_picture(before, then).dot(direction_in_picture(after, now))));
        RC_ASSERT(error < 0.05 * radians);
        RC_ASSERT(after.angles[2] == before.angles[2]);
    });
}

TEST(OpenArenaViewPrediction, TurnsWithATargetThatStaysInTheCentre) {
    const Quaterniond ahead = orientation_of(0, 0, 0);
    const viewer_camera camera = camera_at(1000, {0, 0, 0}, ahead);
    camera_motion motion{};
    camera_motion_take(&motion, &camera);
    const player_pose then = player_at({100, 0, 0}), now = player_at({100, 100, 0});
    const view shown = predict_view(&motion, 1050, &then, &now);
    EXPECT_NEAR(shown.angles[0], 0, 1e-4);
    EXPECT_NEAR(shown.angles[1], 45, 1e-4);
}

// In the upper half of the picture; following below the camera it would be turned over.
TEST(OpenArenaViewPrediction, TurnsAsFarAsItCanWithATargetBelow) {
    const viewer_camera camera = camera_at(1000, {0, 0, 0}, orientation_of(60, 0, 0));
    camera_motion motion{};
    camera_motion_take(&motion, &camera);
    const player_pose then = player_at({100, 0, -80});
    double pitch = 0;
    for (const double x : {80.0, 60.0, 40.0, 20.0, 5.0}) {
        const player_pose now = player_at({x, 0, -100});
        const view shown = predict_view(&motion, 1050, &then, &now);
        EXPECT_GE(shown.angles[0], pitch);
        EXPECT_NEAR(shown.angles[1], 0, 1e-4);
        pitch = shown.angles[0];
    }
    EXPECT_NEAR(pitch, 89, 1e-4);
}

class OpenArenaViewInMotion : public testing::Test {
  protected:
    OpenArenaViewInMotion() {
        for (const int i : {0, 1}) {
            viewer_camera camera =
                camera_at(1000 + 50 * i, {20.0 * i, 0, 0}, orientation_of(10 + i, 179 + 2 * i, 0));
            camera_motion_take(&motion, &camera);
        }
    }
    camera_motion motion{};
};

TEST_F(OpenArenaViewInMotion, GoesOnAsBeforeForAWhile) {
    for (const int time : {1070, 1075, 1100, 1300}) {
        const float steps = static_cast<float>(std::min(time - 1050, 25)) / 50.0F;
        const view shown = predict_view(&motion, time, nullptr, nullptr);
        EXPECT_NEAR(shown.position[0], 20 + 20 * steps, 1e-4);
        EXPECT_NEAR(shown.angles[0], 11 + steps, 1e-3);
        EXPECT_NEAR(shown.angles[1], -179 + 2 * steps, 1e-3);
    }
}

TEST_F(OpenArenaViewInMotion, ATargetThatDiedOrJumpedDoesNotPullTheView) {
    const player_pose then = player_at({100, 0, 0});
    for (const bool died : {true, false}) {
        player_pose now = player_at({100, 900, 0});
        (died ? now.alive : now.teleport_bit) ^= 1;
        EXPECT_NEAR(predict_view(&motion, 1100, &then, &now).angles[1], -178, 1e-3);
    }
}

TEST_F(OpenArenaViewInMotion, AHeldCameraStands) {
    motion.newest.flags = CDIR_CAMERA_HELD;
    const player_pose then = player_at({100, 0, 0}), now = player_at({100, 100, 0});
    const view shown = predict_view(&motion, 1100, &then, &now);
    EXPECT_EQ(shown.position[0], 20);
    EXPECT_NEAR(shown.angles[1], -179, 1e-3);
}

TEST_F(OpenArenaViewInMotion, ASearchingCameraLooksWhereItGoes) {
    motion.newest.flags = CDIR_CAMERA_SEARCHING;
    const player_pose then = player_at({100, 0, 0}), now = player_at({100, 100, 0});
    EXPECT_NEAR(predict_view(&motion, 1100, &then, &now).angles[1], -178, 1e-3);
}

TEST_F(OpenArenaViewInMotion, ANewSegmentBeginsWithoutMotion) {
    viewer_camera camera = camera_at(1100, {500, 0, 0}, orientation_of(0, 0, 0));
    EXPECT_FALSE(camera_motion_take(&motion, &motion.newest)) << "the same camera again";
    camera.segment = 2;
    EXPECT_TRUE(camera_motion_take(&motion, &camera));
    EXPECT_EQ(predict_view(&motion, 1150, nullptr, nullptr).position[0], 500);
}

TEST_F(OpenArenaViewInMotion, ExtremeCamerasGiveFiniteViews) {
    const float huge = std::numeric_limits<float>::max();
    for (const float x : {huge, -huge}) {
        motion.previous.position[0] = -x;
        motion.newest.position[0] = x;
        motion.newest.clearance = huge;
        const player_pose then = player_at({0, 0, 0}), now = player_at({0, 0, 0});
        const view shown = predict_view(&motion, 1250, &then, &now);
        for (int i = 0; i < 3; ++i) {
            EXPECT_TRUE(std::isfinite(shown.position[i]));
            EXPECT_TRUE(std::isfinite(shown.angles[i]));
        }
    }
}

}  // namespace
}  // namespace camdir::openarena
