extern "C" {
#include "game_clock.h"
}

#include <gtest/gtest.h>

namespace camdir::halflife {
namespace {

TEST(HalfLifeGameClock, StepsAreExactAfterADayAndAHalf) {
    const double frame = 0.001;
    double exact = 36.0 * 3600.0;
    game_clock clock{};
    double before = game_clock_advance(&clock, exact, frame);
    EXPECT_EQ(before, exact);
    for (int i = 0; i < 10'000; ++i) {
        exact += frame;
        const double now = game_clock_advance(&clock, static_cast<float>(exact), static_cast<float>(frame));
        EXPECT_NEAR(now - before, frame, 1e-7);
        before = now;
    }
    EXPECT_NEAR(before, exact, 1e-3);
}

TEST(HalfLifeGameClock, FollowsTheEngineOverAJumpAndNeverGoesBack) {
    game_clock clock{};
    EXPECT_EQ(game_clock_advance(&clock, 1.0, 0.01), 1.0);
    EXPECT_EQ(game_clock_advance(&clock, 5.0, 0.01), 5.0);
    EXPECT_EQ(game_clock_advance(&clock, 1.0, 0.01), 5.0);
    EXPECT_EQ(game_clock_advance(&clock, 5.0, -1.0), 5.0);
    clock = {};
    EXPECT_EQ(game_clock_advance(&clock, 1.0, 0.01), 1.0) << "another map";
}

}  // namespace
}  // namespace camdir::halflife
