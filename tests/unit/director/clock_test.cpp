#include "director/clock.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace camdir::director {
namespace {

TEST(SecondsBetween, AreExactHoweverLateTheGamesClockIs) {
    constexpr std::int64_t start = 1'767'225'600'006'000'000;  // of such times doubles know every 256th
    EXPECT_DOUBLE_EQ(seconds_between(start, start + 29'900'000'000), 29.9);
    EXPECT_DOUBLE_EQ(seconds_between(start + 29'900'000'000, start), -29.9);
    EXPECT_DOUBLE_EQ(seconds_between(start, start + 1), 1e-9);
    EXPECT_EQ(seconds_between(start, start), 0.0);
}

TEST(SecondsBetween, KnowDifferencesThatNoIntegerHolds) {
    constexpr std::int64_t first = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t last = std::numeric_limits<std::int64_t>::max();
    EXPECT_EQ(seconds_between(first, last), 0x1p64 * 1e-9);
    EXPECT_EQ(seconds_between(last, first), -0x1p64 * 1e-9);
}

}  // namespace
}  // namespace camdir::director
