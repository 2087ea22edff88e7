#include "evaluation/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "camera/tracker.hpp"
#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

// Free for 150 units around a triangle at the height of the eyes.
freespace::Freespace hall() {
    freespace::Contents contents;
    contents.metadata.map_name = "hall";
    contents.metadata.metres_per_unit = 0.0254F;
    contents.metadata.d0 = 16.0F;
    contents.vertices = {{-600, -600, 100, 150}, {600, -600, 100, 150}, {0, 600, 100, 150}};
    contents.triangles = {{0, 1, 2}};
    return freespace::Freespace::parse(freespace::encode(contents), "hall").value();
}

// Player 1 walks and turns, and is missing from frames 20 to 24; player 7 stands and teleports at frame 30.
Trace walk() {
    Trace trace;
    trace.players = {1, 7};
    for (std::int64_t i = 0; i < 60; ++i) {
        TracePose walking = standing(1, {-200.0 + 5.0 * static_cast<double>(i), 0, 100});
        walking.orientation = quake_orientation(0, 3.0 * static_cast<double>(i), 0);
        walking.discontinuity = i == 0 || i == 25;
        TracePose jumping = standing(7, {i < 30 ? 0.0 : 200.0, -300, 100});
        jumping.discontinuity = i == 0 || i == 30;
        if (i >= 20 && i < 25)
            add_frame(trace, 16 * i, {jumping});
        else
            add_frame(trace, 16 * i, {walking, jumping});
    }
    return trace;
}

const ProgressSink ignored = [](std::uint64_t, std::uint64_t) {};

// The obvious way: one player after the other, by the tracker's own calls.
TEST(Recording, IsTheTrackerStepByStep) {
    const Trace trace = walk();
    const freespace::Freespace freespace = hall();
    const auto recording = record(freespace, {}, trace, {}, trace, 0.0, ignored, {});
    ASSERT_TRUE(recording);
    EXPECT_EQ(recording->step_nanoseconds.size(), 120U);
    for (const std::uint32_t player : trace.players) {
        camera::ShotState state;
        camera::Scratch scratch(freespace);
        std::vector<camera::TimedPose> window;
        for (std::size_t i = 0; i < trace.frames.size(); ++i) {
            const double time = static_cast<double>(trace.frames[i].time - trace.frames[0].time) * 1e-9;
            const auto poses = trace.poses_of(trace.frames[i]);
            const auto found = std::find_if(poses.begin(), poses.end(),
                                            [&](const TracePose& pose) { return pose.player == player; });
            camera::Pose pose;
            if (found != poses.end()) {
                pose.eye = found->eye.cast<float>();
                pose.orientation = found->orientation.cast<float>().normalized();
                pose.discontinuity = found->discontinuity;
            }
            window.push_back({time, pose, found != poses.end()});
            const camera::Camera camera = camera::step(freespace, {}, window, time, state, scratch);
            if (found == poses.end()) continue;
            const std::size_t row = static_cast<std::size_t>(&*found - trace.poses.data());
            EXPECT_EQ(recording->cameras[row].position, camera.position.cast<double>());
            EXPECT_EQ(recording->cameras[row].cut, (camera.flags & camera::cut) != 0);
            EXPECT_EQ(recording->terms[row].total, camera.objective.total);
        }
    }
}

TEST(Recording, IsDeterministic) {
    const Trace trace = walk();
    const auto first = record(hall(), {}, trace, {}, trace, 0.0, ignored, {});
    const auto second = record(hall(), {}, trace, {}, trace, 0.0, ignored, {});
    ASSERT_TRUE(first && second);
    EXPECT_EQ(format_cameras(trace, first->cameras), format_cameras(trace, second->cameras));
    EXPECT_EQ(format_terms(trace, *first), format_terms(trace, *second));
}

TEST(Recording, WritesARowOfTermsForEachPose) {
    const Trace trace = walk();
    const auto recording = record(hall(), {}, trace, {}, trace, 0.0, ignored, {});
    ASSERT_TRUE(recording);
    const std::string text = format_terms(trace, *recording);
    EXPECT_THAT(text, testing::StartsWith("t_ms,player,visibility,distance,angle,inertia_distance,"
                                          "inertia_angle,safety,total\n0,1,"));
    EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), trace.poses.size() + 1);
}

TEST(Recording, StopsWhenAsked) {
    std::stop_source stop;
    stop.request_stop();
    const auto recording = record(hall(), {}, walk(), {}, walk(), 0.0, ignored, stop.get_token());
    ASSERT_FALSE(recording);
    EXPECT_EQ(recording.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace camdir::evaluation
