// What the camera does in each situation of a match.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "freespace/distance.hpp"
#include "walk.hpp"

namespace camdir::camera {
namespace {

bool has(const Camera& camera, std::uint32_t flag) {
    return (camera.flags & flag) != 0;
}

Pose respawned(Pose pose) {
    pose.discontinuity = true;
    return pose;
}

// Steps until the flag shows, at most `frames`; the number of frames it took.
int frames_until(CheckedShot& shot, const Pose& pose, std::uint32_t flag, int frames) {
    for (int i = 1; i <= frames; ++i) {
        if (has(shot.step(pose), flag)) return i;
    }
    return frames + 1;
}

TEST(Situations, TheFirstPoseCutsToTheSpotBehind) {
    const test::Plan plan = test::box_room();
    CheckedShot shot(plan);
    const Pose pose = pose_at(plan.eye(3, 5), 0.0F);
    const Camera camera = shot.step(pose);
    EXPECT_TRUE(has(camera, cut));
    EXPECT_TRUE(has(camera, target_visible));
    EXPECT_LT((camera.position - (pose.eye - Vec3f(120.0F, 0.0F, 0.0F))).norm(), 1.0F);
    EXPECT_LT(angle_between(camera.orientation * Vec3f::UnitX(), pose.eye - camera.position), 1e-3F);
}

TEST(Situations, WithAWallBehindTheCutLandsOnTheBestFreeSpot) {
    const test::Plan plan = test::box_room();
    CheckedShot shot(plan);
    const Pose pose = pose_at(plan.eye(3, 1), 0.0F);
    const Camera camera = shot.step(pose);
    EXPECT_TRUE(has(camera, target_visible));
    EXPECT_GE(camera.clearance, 4.5F);
    EXPECT_GT((camera.position - pose.eye).norm(), 60.0F)
        << "beside the player rather than right behind the head";
}

// The spot right behind who looks at an enemy is on the line itself.
TEST(Situations, ACutStaysOnItsSideOfTheLineOfAction) {
    const test::Plan plan = test::box_room();
    const freespace::Freespace freespace = plan.freespace();
    const Pose pose = pose_at(plan.eye(3, 5), 0.0F);
    for (const float side : {-1.0F, 1.0F}) {
        ShotState state;
        state.line =
            LineOfAction{pose.eye + Vec3f(90.0F, 0.0F, 0.0F), pose.eye + Vec3f(40.0F, side * 30.0F, 0.0F)};
        Scratch scratch(freespace);
        const Camera camera = step(freespace, {}, &pose, 1.0 / 60.0, state, scratch);
        EXPECT_TRUE(has(camera, cut));
        const Vec3f offset = camera.position - pose.eye;
        EXPECT_GT(side * offset.y(), 0.05F * std::abs(offset.x()));
        EXPECT_LT(offset.x(), -60.0F) << "still behind the player";
        EXPECT_FALSE(state.line) << "the next cut is another's";
    }
}

TEST(Situations, RespawnAndTeleportCutAtOnce) {
    const test::Plan plan = test::two_rooms();
    CheckedShot shot(plan);
    shot.step(pose_at(plan.eye('s'), 0.0F));
    const Camera camera = shot.step(respawned(pose_at(plan.eye('t'), 1.0F)));
    EXPECT_TRUE(has(camera, cut));
    EXPECT_TRUE(plan.segment_clear(camera.position, plan.eye('t')));
}

TEST(Situations, ADeadPlayerIsWatchedFromWhereTheCameraComesToRest) {
    const test::Plan plan = test::box_room();
    CheckedShot shot(plan);
    Vec3f eye = plan.eye(3, 4);
    for (int i = 0; i < 30; ++i) {
        eye.x() += 5.0F;
        shot.step(pose_at(eye, 0.0F));
    }
    Pose dead = pose_at(eye, 2.0F);
    dead.alive = false;
    ASSERT_LE(frames_until(shot, dead, held, 120), 120);
    const Vec3f rest = shot.state().position;
    dead.eye.y() += 60.0F;
    Camera camera;
    for (int i = 0; i < 60; ++i)
        camera = shot.step(dead);
    EXPECT_EQ(camera.position, rest);
    EXPECT_TRUE(has(camera, held));
    EXPECT_LT(angle_between(camera.orientation * Vec3f::UnitX(), dead.eye - rest), 1e-2F);
}

// A rocket throws the body past the camera: who fired it stays in the picture for a while.
TEST(Situations, TheCameraDoesNotSpinAfterABodyThatFliesPast) {
    const test::Plan plan = test::box_room();
    CheckedShot shot(plan);
    const Vec3f eye = plan.eye(3, 4);
    Vec3f before;
    for (int i = 0; i < 30; ++i)
        before = shot.step(pose_at(eye, 0.0F)).orientation * Vec3f::UnitX();
    Pose body = pose_at(eye, 0.0F);
    body.alive = false;
    Vec3f looked = before;
    for (int i = 0; i < 30; ++i) {
        body.eye.x() -= 10.0F;  // 600 units/s
        const Vec3f looks = shot.step(body).orientation * Vec3f::UnitX();
        EXPECT_LT(angle_between(looks, looked), 1.01F * (std::numbers::pi_v<float> / 2.0F) / 60.0F) << i;
        looked = looks;
    }
    EXPECT_GT(angle_between(looked, before), 0.3F) << "but it looks after them";
}

TEST(Situations, AMissingPlayerHoldsTheCamera) {
    const test::Plan plan = test::box_room();
    CheckedShot shot(plan);
    const Camera before = shot.step(pose_at(plan.eye(3, 5), 0.0F));
    Pose broken = pose_at(plan.eye(3, 6), 0.0F);
    broken.eye.y() = std::numeric_limits<float>::quiet_NaN();
    for (const Pose* pose : {static_cast<const Pose*>(nullptr), static_cast<const Pose*>(&broken)}) {
        const Camera camera = shot.step(pose);
        EXPECT_EQ(camera.position, before.position);
        EXPECT_EQ(camera.orientation.coeffs(), before.orientation.coeffs());
        EXPECT_EQ(camera.flags, std::uint32_t{target_absent | held});
    }
    EXPECT_EQ(shot.step(pose_at(plan.eye(3, 5), 0.0F)).flags, std::uint32_t{target_visible}) << "back again";
}

TEST(Situations, APlayerBackWhereTheCameraCannotGoIsCutToAfterTheTimeLimit) {
    const test::Plan plan = test::two_rooms();
    CheckedShot shot(plan);
    shot.step(pose_at(plan.eye('s'), 0.0F));
    shot.step(nullptr);
    const Pose back = pose_at(plan.eye('t'), 0.0F);
    EXPECT_TRUE(has(shot.step(back), searching));
    const int frames = frames_until(shot, back, cut, 200);
    EXPECT_NEAR(frames, Profile{}.search_time_limit * 60.0F, 3.0F);
    EXPECT_TRUE(plan.segment_clear(shot.state().position, back.eye));
}

TEST(Situations, ALostPlayerIsFoundAlongTheRoadmapWithoutACut) {
    const test::Plan plan = test::l_corridor();
    Profile patient;
    patient.search_time_limit = 30.0F;
    CheckedShot shot(plan, patient);
    shot.step(pose_at(plan.eye('s'), 0.0F));
    const Pose gone = pose_at(plan.eye('t'), -1.5F);
    EXPECT_TRUE(has(shot.step(gone), searching));
    EXPECT_LE(frames_until(shot, gone, target_visible, 300), 300);
    EXPECT_EQ(shot.cuts(), 1);
}

TEST(Situations, AFarPlayerInSightIsCaughtUpWith) {
    const test::Plan plan = test::figure_eight();
    CheckedShot shot(plan);
    shot.step(pose_at(plan.eye(6, 1), 0.0F));
    const Pose far = pose_at(plan.eye(6, 15), 0.0F);
    Camera camera;
    for (int i = 0; i < 120; ++i)
        camera = shot.step(far);
    EXPECT_EQ(shot.cuts(), 1);
    EXPECT_NEAR((camera.position - far.eye).norm(), 120.0F, 10.0F);
}

TEST(Situations, APlayerInsideAWallIsFollowedUpToIt) {
    const test::Plan plan = test::box_room();
    CheckedShot shot(plan);
    Vec3f eye = plan.eye(3, 7);
    for (int i = 0; i < 120; ++i) {
        eye.x() += 5.0F;  // ends far outside
        const Camera camera = shot.step(pose_at(eye, 0.0F));
        if (plan.clearance(eye) <= 0.0F) {
            EXPECT_FALSE(has(camera, target_visible));
        }
    }
    EXPECT_TRUE(has(shot.step(pose_at(eye, 0.0F)), searching));
    EXPECT_EQ(shot.cuts(), 1);
}

TEST(Situations, AShotThatBeginsOnAPlayerInsideAWallStandsInFreespace) {
    const test::Plan plan = test::box_room();
    CheckedShot shot(plan);
    const Camera camera = shot.step(pose_at(Vec3f(10.0F, 200.0F, 54.0F), 0.0F));
    EXPECT_TRUE(has(camera, cut));
    EXPECT_FALSE(has(camera, target_visible));
    EXPECT_GT(plan.clearance(camera.position), 4.0F);
}

TEST(Situations, BeforeAnyPoseTheCameraWaitsAtASpawnPoint) {
    const test::Plan plan = test::box_room();
    CheckedShot shot(plan);
    const Camera camera = shot.step(nullptr);
    EXPECT_EQ(camera.flags, std::uint32_t{target_absent | held | cut}) << "nobody saw it come";
    EXPECT_EQ(camera.position, plan.eye('s'));
    EXPECT_EQ(shot.step(nullptr).flags, std::uint32_t{target_absent | held});
    EXPECT_TRUE(has(shot.step(pose_at(plan.eye('t'), 0.0F)), cut));
}

TEST(Situations, OddTimesCountAsFrames) {
    const test::Plan plan = test::box_room();
    const auto run = [&](double dt) {
        CheckedShot shot(plan);
        shot.step(pose_at(plan.eye(3, 4), 0.0F));
        return shot.step(pose_at(plan.eye(3, 5), 0.5F), dt).position;
    };
    const Vec3f usual = run(1.0 / 60.0F);
    EXPECT_EQ(run(0.0), usual);
    EXPECT_EQ(run(-3.0), usual);
    EXPECT_EQ(run(std::numeric_limits<double>::quiet_NaN()), usual);
    EXPECT_EQ(run(std::numeric_limits<double>::infinity()), usual);
    EXPECT_EQ(run(1000.0), run(0.25));
}

TEST(Situations, AMapWithoutFreespaceStillGivesFiniteCameras) {
    freespace::Contents contents = test::box_room().contents();
    for (freespace::Vertex& vertex : contents.vertices)
        vertex.free_distance = -1.0F;
    const auto freespace = freespace::Freespace::parse(freespace::encode(contents), "solid").value();
    Scratch scratch(freespace);
    ShotState state;
    const Pose pose = pose_at(Vec3f(300.0F, 300.0F, 54.0F), 1.0F);
    for (int i = 0; i < 10; ++i) {
        const Camera camera = step(freespace, {}, i % 3 == 0 ? nullptr : &pose, 0.016, state, scratch);
        EXPECT_TRUE(camera.position.allFinite());
        EXPECT_LE(camera.clearance, 0.0F);
    }
}

TEST(Situations, AMapInMetresShowsTheSame) {
    const test::Plan plan = test::l_corridor();
    const freespace::Freespace units = plan.freespace();
    freespace::Contents contents = plan.contents(1.0F);
    constexpr float metre = 0.0254F;
    for (freespace::Vertex& vertex : contents.vertices) {
        vertex = {vertex.x * metre, vertex.y * metre, vertex.z * metre, vertex.free_distance * metre};
    }
    const auto metres = freespace::Freespace::parse(freespace::encode(contents), "metres").value();
    Runner runner(plan, plan.eye('s'), 2);
    Scratch units_scratch(units);
    Scratch metres_scratch(metres);
    ShotState units_state;
    ShotState metres_state;
    for (int i = 0; i < 120; ++i) {
        Pose pose = runner.next(1.0F / 60.0F);
        const Camera a = step(units, {}, &pose, 1.0 / 60.0, units_state, units_scratch);
        pose.eye *= metre;
        pose.velocity *= metre;
        const Camera b = step(metres, {}, &pose, 1.0 / 60.0, metres_state, metres_scratch);
        EXPECT_LT((a.position - b.position / metre).norm(), 1.0F) << "frame " << i;
        EXPECT_EQ(a.flags, b.flags);
    }
}

TEST(Situations, ACopyOfTheStateGoesOnAlike) {
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    Runner runner(plan, plan.eye('s'), 5);
    Scratch one(freespace);
    ShotState state;
    for (int i = 0; i < 100; ++i) {
        const Pose pose = runner.next(1.0F / 60.0F);
        (void)step(freespace, {}, &pose, 1.0 / 60.0, state, one);
    }
    ShotState copy = state;
    Scratch other(freespace);
    for (int i = 0; i < 100; ++i) {
        const Pose pose = runner.next(1.0F / 60.0F);
        const Camera a = step(freespace, {}, &pose, 1.0 / 60.0, state, one);
        const Camera b = step(freespace, {}, &pose, 1.0 / 60.0, copy, other);
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
        EXPECT_EQ(a.flags, b.flags);
    }
}

}  // namespace
}  // namespace camdir::camera
