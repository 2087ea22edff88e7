// Other players, whose bodies are soft.
#include "camera/crowd.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "walk.hpp"

namespace camdir::camera {
namespace {

constexpr double frame = 1.0 / 60.0;

using Track = std::vector<TimedPose>;

Track standing(const Vec3f& eye, double seconds) {
    Track track;
    for (double time = 0.0; time <= seconds; time += frame)
        track.push_back({time, pose_at(eye, 0.0F)});
    return track;
}

TEST(Bystanders, AreTheNearestOfTheLivingOthers) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> place(-200.0F, 200.0F);
    for (int round = 0; round < 200; ++round) {
        std::vector<Track> tracks(round % 40);
        std::vector<Crowd::Player> players;
        std::vector<float> expected;
        for (std::uint32_t id = 0; id < tracks.size(); ++id) {
            TimedPose pose{1.0, pose_at({place(random), place(random), 0.0F}, 0.0F)};
            pose.present = id % 5 != 3;
            pose.pose.alive = id % 7 != 2;
            tracks[id] = {pose};
            players.push_back({id, tracks[id]});
            const float distance = pose.pose.eye.norm();
            if (id != 1 && pose.present && pose.pose.alive && distance < 200.0F) expected.push_back(distance);
        }
        std::ranges::sort(expected);
        expected.resize(std::min(expected.size(), Bystanders::capacity));
        Bystanders near({players, 1}, Vec3f::Zero(), 1.0, 200.0F);
        EXPECT_EQ(near.empty(), expected.empty());
        std::vector<float> found;
        for (const Vec3f& eye : near.eyes_at(1.0))
            found.push_back(eye.norm());
        EXPECT_THAT(found, testing::Pointwise(testing::FloatEq(), expected));
    }
}

TEST(Bystanders, RunOnAfterTheLastPoseForAWhile) {
    TimedPose first{1.0, pose_at({10.0F, 0.0F, 0.0F}, 0.0F)};
    TimedPose second{1.1, pose_at({20.0F, 0.0F, 0.0F}, 0.0F)};
    second.pose.velocity = Vec3f(0.0F, 100.0F, 0.0F);
    const Track track{first, second};
    const Crowd::Player player{5, track};
    Bystanders near({{&player, 1}, 0}, Vec3f::Zero(), 1.0, 100.0F);
    const auto eye = [&](double time) { return near.eyes_at(time).front(); };
    EXPECT_TRUE(eye(1.05).isApprox(Vec3f(15.0F, 0.0F, 0.0F), 1e-4F));
    EXPECT_TRUE(eye(1.3).isApprox(Vec3f(20.0F, 20.0F, 0.0F), 1e-4F));
    EXPECT_TRUE(eye(9.0).isApprox(Vec3f(20.0F, 50.0F, 0.0F), 1e-4F));
    EXPECT_TRUE(near.eyes_at(0.9).empty());
}

Vec3f level(const Vec3f& way) {
    return {way.x(), way.y(), 0.0F};
}

// How far the line of sight passes the other's middle line, level.
float passes_by(const Vec3f& camera, const Vec3f& eye, const Vec3f& other) {
    const Vec3f way = level(eye - camera);
    const Vec3f to = level(other - camera);
    const float share = std::clamp(to.dot(way) / way.squaredNorm(), 0.0F, 1.0F);
    return (to - share * way).norm();
}

struct Past : testing::TestWithParam<bool> {};

// One who stands right behind the player would fill the picture.
TEST_P(Past, TheCameraLooksPastWhoStandsBehindThePlayer) {
    const test::Plan plan = test::box_room();
    const freespace::Freespace freespace = plan.freespace();
    const Vec3f eye = plan.eye(3, 5);
    const Vec3f other = eye - Vec3f(60.0F, 0.0F, 0.0F);
    constexpr double seconds = 3.0;
    const Track own = standing(eye, seconds);
    const Track behind = standing(other, seconds);
    const auto known = [&](const Track& track, std::size_t now) {
        const std::size_t end = GetParam() ? track.size() : now + 1;
        const std::size_t begin = now < 12 ? 0 : now - 12;
        return Window(track).subspan(begin, end - begin);
    };
    for (const bool crowded : {false, true}) {
        ShotState state;
        state.time = -frame;
        Scratch scratch(freespace);
        Camera camera;
        for (std::size_t i = 0; i < own.size() / 2; ++i) {
            const Crowd::Player players[] = {{1, known(own, i)}, {2, known(behind, i)}};
            const Crowd crowd{players, 1};
            camera =
                step(freespace, {}, known(own, i), own[i].time, state, scratch, crowded ? crowd : Crowd{});
        }
        EXPECT_NE(camera.flags & target_visible, 0U);
        if (crowded)
            EXPECT_GT(passes_by(camera.position, eye, other), 15.0F) << "half of a body";
        else
            EXPECT_LT(passes_by(camera.position, eye, other), 5.0F);
    }
}

INSTANTIATE_TEST_SUITE_P(LiveAndDelayed, Past, testing::Bool());

// They are no obstacles.
TEST(Crowd, WhoFillsTheWayOfTheCameraHidesNobody) {
    const test::Plan plan = test::box_room();
    const freespace::Freespace freespace = plan.freespace();
    const Vec3f eye = plan.eye(3, 5);
    std::vector<Track> ring;
    for (int i = 0; i < 8; ++i) {
        const float angle = 0.785F * static_cast<float>(i);
        ring.push_back({{0.0, pose_at(eye + 40.0F * Vec3f(std::cos(angle), std::sin(angle), 0.0F), 0.0F)}});
    }
    std::vector<Crowd::Player> players;
    for (const Track& track : ring)
        players.push_back({static_cast<std::uint32_t>(players.size() + 2), track});
    ShotState state;
    Scratch scratch(freespace);
    const Pose pose = pose_at(eye, 0.0F);
    for (int i = 0; i < 60; ++i) {
        const Camera camera = step(freespace, {}, &pose, frame, state, scratch, {players, 1});
        EXPECT_NE(camera.flags & target_visible, 0U);
        EXPECT_GT((camera.position - eye).norm(), 60.0F);
    }
}

}  // namespace
}  // namespace camdir::camera
