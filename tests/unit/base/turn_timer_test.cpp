#include "base/turn_timer.hpp"

#include <gtest/gtest.h>

#include "support/eventually.hpp"

namespace camdir {
namespace {

TEST(TurnTimer, OnlyATurnThatGoesOnCanTakeTooLong) {
    using std::chrono::milliseconds;
    TurnTimer turn;
    EXPECT_TRUE(turn.within(milliseconds(0)));
    turn.begin();
    EXPECT_TRUE(turn.within(test::patience));
    EXPECT_TRUE(test::eventually([&] { return !turn.within(milliseconds(1)); }));
    EXPECT_TRUE(turn.within(test::patience));
    turn.end();
    EXPECT_TRUE(turn.within(milliseconds(0)));
}

}  // namespace
}  // namespace camdir
