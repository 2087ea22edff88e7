#include "display_clock.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "support/camera_frames.hpp"

namespace camdir::sdk {
namespace {

using test::ms;

constexpr std::int64_t delay = 50 * ms;
constexpr std::int64_t period = 16 * ms;
constexpr std::int64_t start = 123'456'789 * ms;  // the host's clock when frame_time is 0

TEST(DisplayClock, NothingToDisplayBeforeTheFirstFrame) {
    DisplayClock clock(delay);
    EXPECT_FALSE(clock.at(start));
    clock.observe(0, start);
    EXPECT_TRUE(clock.at(start));
    clock.clear();
    EXPECT_FALSE(clock.at(start));
}

TEST(DisplayClock, RunsTheDelayBehindRegularFrames) {
    DisplayClock clock(delay);
    for (std::int64_t time = 0; time < 1000 * ms; time += period) {
        clock.observe(time, start + time);
        EXPECT_EQ(clock.at(start + time + 5 * ms), time + 5 * ms - delay);
    }
}

// Frames arrive up to 30 ms late: the display time advances almost at real time and stays before the newest
// frame.
TEST(DisplayClock, JitterOfTheNetworkDoesNotReachTheDisplay) {
    const unsigned seed = 7;
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::int64_t> lateness(0, 30 * ms);
    DisplayClock clock(delay);
    std::int64_t last = 0;
    for (std::int64_t time = 0; time < 20'000 * ms; time += period) {
        const std::int64_t arrival = start + time + lateness(random);
        clock.observe(time, arrival);
        const std::int64_t now = start + time + 30 * ms;
        const std::int64_t displayed = *clock.at(now);
        if (time > 2000 * ms) {
            EXPECT_GE(displayed - last, period - period / 10 - 1) << "seed " << seed;
            EXPECT_LE(displayed - last, period + period / 10 + 1) << "seed " << seed;
            EXPECT_LT(displayed, time) << "there must be a later frame; seed " << seed;
            EXPECT_NEAR(static_cast<double>(displayed), static_cast<double>(now - start - delay), 2.0 * ms);
        }
        last = displayed;
    }
}

TEST(DisplayClock, NeverPassesTheNewestFrameAndNeverGoesBack) {
    const unsigned seed = 11;
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::int64_t> step(0, 400 * ms);
    DisplayClock clock(delay);
    std::int64_t now = start;
    std::int64_t newest = 0;
    std::int64_t last = std::numeric_limits<std::int64_t>::min();
    for (int i = 0; i < 10'000; ++i) {
        now += step(random);
        newest += step(random);
        clock.observe(newest, now);
        const std::int64_t displayed = *clock.at(now + step(random) / 8);
        EXPECT_LE(displayed, newest) << "seed " << seed << " step " << i;
        EXPECT_GE(displayed, last) << "seed " << seed << " step " << i;
        last = displayed;
    }
}

// The game pauses for ten seconds, and the display with it.
TEST(DisplayClock, ContinuesAfterAPauseOfTheGame) {
    DisplayClock clock(delay);
    const std::int64_t before = 1600 * ms;
    for (std::int64_t time = 0; time <= before; time += period) {
        clock.observe(time, start + time);
        (void)clock.at(start + time);
    }
    EXPECT_EQ(clock.at(start + before + 5000 * ms), before);
    const std::int64_t resumed = start + 10'000 * ms;
    std::int64_t displayed = 0;
    std::int64_t time = before;
    while (time < before + 500 * ms) {
        time += period;
        clock.observe(time, resumed + time);
        displayed = *clock.at(resumed + time);
    }
    EXPECT_NEAR(static_cast<double>(displayed), static_cast<double>(time - delay), 1.0 * ms);
}

TEST(DisplayClock, FollowsAClockThatDrifts) {
    DisplayClock clock(delay);
    std::int64_t now = start;
    for (std::int64_t time = 0; time < 60'000 * ms; time += period) {
        now += period + period / 1000;  // a thousandth slower than the game's
        clock.observe(time, now);
        const std::int64_t displayed = *clock.at(now);
        // The window looks back 64 frames, in which the clocks drift apart by 1 ms.
        EXPECT_NEAR(static_cast<double>(displayed), static_cast<double>(time - delay), 1.5 * ms);
    }
}

}  // namespace
}  // namespace camdir::sdk
