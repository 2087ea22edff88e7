#include "director/timeline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stage.hpp"

namespace camdir::director {
namespace {

struct Seen {
    std::uint32_t id;
    std::uint32_t flags = pose_alive;
};

class TimelineTest : public testing::Test {
  protected:
    bool add(std::int64_t time_ms, const std::vector<Seen>& players = {{1}}) {
        PoseFrame frame;
        frame.frame_time = time_ms * ms;
        for (const auto& [id, flags] : players)
            frame.poses.push_back({id, Vec3f(static_cast<float>(time_ms), 0.0F, 0.0F), Quatf::Identity(),
                                   Vec3f::Zero(), flags});
        return timeline_.add(frame, frame.poses);
    }

    Timeline timeline_;
};

TEST_F(TimelineTest, HoldsThePosesInTime) {
    EXPECT_FALSE(timeline_.covers(5000 * ms));
    for (std::int64_t time = 5000; time <= 7500; time += 50)
        EXPECT_TRUE(add(time));
    EXPECT_TRUE(timeline_.covers(5000 * ms));
    EXPECT_TRUE(timeline_.covers(7500 * ms));
    EXPECT_FALSE(timeline_.covers(7501 * ms));
    timeline_.show(5100 * ms);
    EXPECT_DOUBLE_EQ(timeline_.shown(), 0.1);
    const camera::Window window = timeline_.window(1);
    ASSERT_EQ(window.size(), 51U);
    EXPECT_DOUBLE_EQ(window.front().time, 0.0);
    EXPECT_DOUBLE_EQ(window.back().time, 2.5);
    EXPECT_EQ(window.back().pose.eye.x(), 7500.0F);
    EXPECT_TRUE(timeline_.window(2).empty());
}

// Cameras decide at tenths of a second: a standby that comes later at those of its leader.
TEST_F(TimelineTest, TenthsOfASecondAreTheSameWhereverItBegins) {
    for (const std::int64_t begin : {-1337, -1300, 0, 1250, 4999}) {
        timeline_.clear();
        add(begin);
        for (const std::int64_t tenth : {-2000, 0, 7300})
            EXPECT_NEAR(std::remainder(timeline_.seconds(tenth * ms), 0.1), 0.0, 1e-9) << begin;
        EXPECT_GE(timeline_.seconds(begin * ms), 0.0);
        EXPECT_LT(timeline_.seconds(begin * ms), 0.1);
    }
    timeline_.clear();
    PoseFrame earliest;
    earliest.frame_time = std::numeric_limits<std::int64_t>::min();
    EXPECT_TRUE(timeline_.add(earliest, {}));
    EXPECT_EQ(timeline_.seconds(earliest.frame_time), 0.0);
}

TEST_F(TimelineTest, ForgetsWhatIsOver) {
    for (std::int64_t time = 0; time <= 60000; time += 20) {
        add(time, time < 10000 ? std::vector<Seen>{{1}, {2}} : std::vector<Seen>{{1}});
        if (time >= 1000) timeline_.show((time - 1000) * ms);
    }
    const camera::Window window = timeline_.window(1);
    EXPECT_LE(window.front().time, timeline_.shown() - 0.25);
    EXPECT_GE(window.front().time, timeline_.shown() - 1.0);
    EXPECT_LE(window.size(), 100U);
    EXPECT_TRUE(timeline_.window(2).empty());
}

TEST_F(TimelineTest, KnowsWhenAPlayerIsAbsent) {
    add(0, {{1}, {2}});
    add(50, {{2}});
    add(100, {{1, pose_alive | pose_spectator}, {2}});
    add(150, {{1, pose_alive | pose_discontinuity}, {2}, {2}});
    const camera::Window window = timeline_.window(1);
    ASSERT_EQ(window.size(), 3U);
    EXPECT_FALSE(window[1].present);
    EXPECT_DOUBLE_EQ(window[1].time, 0.05);
    EXPECT_TRUE(window[2].present);
    EXPECT_TRUE(window[2].pose.discontinuity);
    EXPECT_EQ(timeline_.window(2).size(), 4U);
}

TEST_F(TimelineTest, KnowsOfATeleportWhoseFrameWasLost) {
    const auto add_counted = [&](std::int64_t time_ms, std::uint32_t discontinuities) {
        PoseFrame frame;
        frame.frame_time = time_ms * ms;
        frame.poses.push_back(
            {1, Vec3f::Zero(), Quatf::Identity(), Vec3f::Zero(), pose_alive, discontinuities});
        return timeline_.add(frame, frame.poses);
    };
    add_counted(0, 4);
    add_counted(50, 4);
    add_counted(50, 5);  // the clock stands still: not a frame of the timeline
    add_counted(100, 5);
    add_counted(150, 5);
    const camera::Window window = timeline_.window(1);
    ASSERT_EQ(window.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(window[i].pose.discontinuity, i == 2) << i;
    timeline_.clear();
    add_counted(0, 6);
    EXPECT_FALSE(timeline_.window(1)[0].pose.discontinuity);
}

TEST_F(TimelineTest, HoldsTheMoversFromTheFirstFrameThatHasSome) {
    const auto movers = std::make_shared<const MatchMovers>();
    const auto add_with = [&](std::int64_t time_ms, std::shared_ptr<const MatchMovers> among) {
        PoseFrame frame;
        frame.frame_time = time_ms * ms;
        frame.movers = std::move(among);
        return timeline_.add(frame, frame.poses);
    };
    add_with(0, nullptr);
    EXPECT_TRUE(timeline_.movers().empty());
    for (std::int64_t time = 50; time <= 10000; time += 50)
        add_with(time, movers);
    add_with(10050, nullptr);
    ASSERT_EQ(timeline_.movers().size(), 201U);
    EXPECT_DOUBLE_EQ(timeline_.movers().front().time, 0.05);
    EXPECT_EQ(timeline_.movers().front().movers, movers);
    EXPECT_EQ(timeline_.movers().back().movers, nullptr);
    timeline_.show(9000 * ms);
    EXPECT_LE(timeline_.movers().front().time, 9.0 - 0.25);
    EXPECT_LT(timeline_.movers().size(), 80U);
    timeline_.clear();
    EXPECT_TRUE(timeline_.movers().empty());
}

TEST_F(TimelineTest, AClockThatStandsStillAddsNothing) {
    EXPECT_TRUE(add(5000));
    EXPECT_TRUE(add(5000));
    EXPECT_TRUE(add(4500));
    EXPECT_EQ(timeline_.window(1).size(), 1U);
    timeline_.show(5000 * ms);
    EXPECT_TRUE(timeline_.covers(4500 * ms));
    timeline_.show(4500 * ms);
    EXPECT_DOUBLE_EQ(timeline_.shown(), 0.0);
}

TEST_F(TimelineTest, AClockThatGoesBackBeginsAnotherTimeline) {
    add(5000);
    timeline_.show(5000 * ms);
    EXPECT_FALSE(add(3900));
    EXPECT_FALSE(timeline_.covers(3900 * ms));
    timeline_.clear();
    EXPECT_TRUE(add(3900));
    EXPECT_TRUE(timeline_.covers(3900 * ms));
    EXPECT_TRUE(add(90000)) << "ahead it may jump";
    EXPECT_EQ(timeline_.window(1).size(), 2U);
}

}  // namespace
}  // namespace camdir::director
