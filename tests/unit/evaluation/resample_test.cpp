#include "evaluation/resample.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TracePose turned(TracePose pose, double yaw) {
    pose.orientation = quake_orientation(0, yaw, 0);
    return pose;
}

TracePose jumped(TracePose pose) {
    pose.discontinuity = true;
    return pose;
}

TracePose dead(TracePose pose) {
    pose.alive = false;
    return pose;
}

std::vector<double> eye_x(const Trace& trace) {
    std::vector<double> x;
    for (const TracePose& pose : trace.poses)
        x.push_back(pose.eye.x());
    return x;
}

std::vector<bool> discontinuities(const Trace& trace) {
    std::vector<bool> marks;
    for (const TracePose& pose : trace.poses)
        marks.push_back(pose.discontinuity);
    return marks;
}

TEST(Resample, InterpolatesBetweenFrames) {
    Trace trace;
    trace.players = {1};
    add_frame(trace, 100, {turned(standing(1, {0, 0, 0}), 350)});
    add_frame(trace, 140, {turned(standing(1, {8, 4, 0}), 30)});
    trace.poses[0].velocity = {0, 0, 100};
    const auto faster = resample(trace, 100.0);
    ASSERT_TRUE(faster);
    EXPECT_EQ(faster->players, trace.players);
    EXPECT_EQ(faster->frames.front().time, 100'000'000);
    EXPECT_EQ(faster->frames.back().time, 140'000'000);
    EXPECT_THAT(eye_x(*faster), ElementsAre(0, 2, 4, 6, 8));
    EXPECT_EQ(faster->poses[1].velocity, Vec3d(0, 0, 75));
    EXPECT_LT(faster->poses[2].orientation.angularDistance(quake_orientation(0, 10, 0)), 1e-12);
}

TEST(Resample, HoldsAcrossJumpsDeathsAndAbsences) {
    Trace trace;
    trace.players = {1, 2};
    add_frame(trace, 0, {standing(1, {0, 0, 0})});
    add_frame(trace, 20, {jumped(standing(1, {100, 0, 0}))});
    add_frame(trace, 40, {dead(standing(1, {110, 0, 0}))});
    add_frame(trace, 60, {standing(2, {7, 0, 0})});
    const auto faster = resample(trace, 100.0);
    ASSERT_TRUE(faster);
    EXPECT_THAT(eye_x(*faster), ElementsAre(0, 0, 100, 100, 110, 110, 7));
    EXPECT_THAT(discontinuities(*faster), ElementsAre(false, false, true, false, false, false, false));
    EXPECT_EQ(faster->poses.back().player, 2U);
}

TEST(Resample, KeepsADiscontinuityOfASkippedFrame) {
    Trace trace;
    trace.players = {1};
    add_frame(trace, 0, {jumped(standing(1, {0, 0, 0}))});
    add_frame(trace, 10, {jumped(standing(1, {1, 0, 0}))});
    for (std::int64_t t = 20; t <= 60; t += 10)
        add_frame(trace, t, {standing(1, {2, 0, 0})});
    const auto slower = resample(trace, 1000.0 / 30.0);
    ASSERT_TRUE(slower);
    EXPECT_THAT(discontinuities(*slower), ElementsAre(true, true, false));
}

TEST(Resample, SameRateIsTheSameTrace) {
    Trace trace;
    trace.players = {1};
    for (std::int64_t i = 0; i < 50; ++i)
        add_frame(trace, 8 + 16 * i, {standing(1, {double(i), 0, 0})});
    const auto same = resample(trace, 62.5);
    ASSERT_TRUE(same);
    EXPECT_EQ(eye_x(*same), eye_x(trace));
    ASSERT_EQ(same->frames.size(), trace.frames.size());
    for (std::size_t i = 0; i < trace.frames.size(); ++i)
        EXPECT_EQ(same->frames[i].time, trace.frames[i].time);
}

TEST(Resample, RefusesMorePosesThanFitMemory) {
    Trace trace;
    trace.players = {1};
    add_frame(trace, 0, {standing(1, {0, 0, 0})});
    add_frame(trace, 1'000'000'000, {standing(1, {0, 0, 0})});
    const auto huge = resample(trace, 1000.0);
    ASSERT_FALSE(huge);
    EXPECT_THAT(huge.error().message, HasSubstr("50 million"));
}

}  // namespace
}  // namespace camdir::evaluation
