#include "quakeworld/tracker.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace camdir::quakeworld {
namespace {

Frame frame_at(std::int64_t time, double x, double yaw = 0.0) {
    Frame frame;
    frame.time = time;
    frame.poses.push_back({.slot = 4, .origin = Vec3d(x, 0, 0), .angles = Vec3d(0, yaw, 0)});
    return frame;
}

TEST(Tracker, HandsOutAFrameWhenTheNext120MsAreKnown) {
    Tracker tracker;
    tracker.add(frame_at(0, 0));
    tracker.add(frame_at(120, 1));
    EXPECT_FALSE(tracker.next());
    tracker.add(frame_at(121, 2));
    EXPECT_EQ(tracker.next().value().time, 0);
    EXPECT_FALSE(tracker.next());
    tracker.finish();
    EXPECT_EQ(tracker.next().value().time, 120);
    EXPECT_EQ(tracker.next().value().time, 121);
    EXPECT_FALSE(tracker.next());
}

TEST(Tracker, KeepsWhatHappensWhileNobodyMoves) {
    Tracker tracker;
    Frame happening;
    happening.occurrences.push_back({.kind = Occurrence::Kind::match_end});
    tracker.add(happening);  // before anybody plays
    tracker.add(frame_at(10, 0));
    happening.time = 20;
    tracker.add(happening);
    tracker.finish();
    EXPECT_EQ(tracker.next().value().occurrences.size(), 1U);
    EXPECT_FALSE(tracker.next());
}

// However early the frames are asked for, they are what they are at the end.
RC_GTEST_PROP(TrackerProperty, AskingEarlyMakesNoDifference, ()) {
    std::vector<Frame> frames;
    std::int64_t time = 0;
    for (int i = *rc::gen::inRange(1, 60); i > 0; --i) {
        time += *rc::gen::inRange(1, 60);
        frames.push_back(
            frame_at(time, *rc::gen::inRange(0, 4) == 0 ? 500.0 : 0.0, *rc::gen::inRange(0, 360)));
        frames.back().poses[0].alive = *rc::gen::inRange(0, 6) != 0;
        if (*rc::gen::inRange(0, 6) == 0) frames.back().poses.clear();
    }
    const auto track = [&](bool early) {
        Tracker tracker;
        std::vector<TrackedFrame> tracked;
        const auto take = [&] {
            while (auto frame = tracker.next())
                tracked.push_back(std::move(*frame));
        };
        for (const Frame& frame : frames) {
            tracker.add(frame);
            if (early) take();
        }
        tracker.finish();
        take();
        return tracked;
    };
    const auto early = track(true);
    const auto late = track(false);
    RC_ASSERT(early.size() == late.size());
    for (std::size_t i = 0; i < early.size(); ++i) {
        RC_ASSERT(early[i].time == late[i].time);
        RC_ASSERT(early[i].poses.size() == late[i].poses.size());
        for (std::size_t pose = 0; pose < early[i].poses.size(); ++pose) {
            const TrackedPose& a = early[i].poses[pose];
            const TrackedPose& b = late[i].poses[pose];
            RC_ASSERT(a.eye == b.eye && a.orientation.coeffs() == b.orientation.coeffs() &&
                      a.velocity == b.velocity && a.alive == b.alive && a.discontinuity == b.discontinuity);
        }
    }
}

}  // namespace
}  // namespace camdir::quakeworld
