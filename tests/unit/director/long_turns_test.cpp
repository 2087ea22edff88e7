#include "director/long_turns.hpp"

#include <gtest/gtest.h>

#include "stage.hpp"

namespace camdir::director {
namespace {

LongTurns::Cost turn_of(std::int64_t time_ms) {
    return {time_ms * ms, time_ms * ms};
}

TEST(LongTurns, ShortOnesAreNoneWhateverTheyFollow) {
    LongTurns turns;
    for (int i = 0; i < 20; ++i) {
        turns.moved(turn_of(i % 5 == 0 ? 60 : 5));
        EXPECT_FALSE(turns.is_long());
        EXPECT_EQ(turns.worked(), 0);
    }
}

TEST(LongTurns, TwoInARowSayAll) {
    LongTurns turns;
    turns.moved(turn_of(100));
    EXPECT_FALSE(turns.is_long());
    turns.moved(turn_of(80));
    EXPECT_TRUE(turns.is_long());
    EXPECT_EQ(turns.worked(), 80 * ms);
}

TEST(LongTurns, AStallOfTheMachineIsNone) {
    LongTurns turns;
    for (int i = 0; i < 20; ++i) {
        turns.moved(turn_of(i % 5 == 0 ? 500 : 8));
        EXPECT_FALSE(turns.is_long());
    }
}

TEST(LongTurns, OfALongOneTheNextAreMeasuredCloser) {
    LongTurns turns;
    turns.moved(turn_of(19));
    EXPECT_FALSE(turns.is_suspect());
    turns.moved(turn_of(20));
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(turns.is_suspect()) << i;
        turns.moved(turn_of(19));
    }
    EXPECT_FALSE(turns.is_suspect());
}

TEST(LongTurns, AVeryLongOneSaysSomethingAtOnce) {
    LongTurns turns;
    turns.moved(turn_of(1));
    turns.moved(turn_of(4000));
    EXPECT_TRUE(turns.is_long());
    EXPECT_EQ(turns.worked(), 1 * ms)
        << "it may have been a stall, after which nobody should rest for seconds";
    turns.moved(turn_of(1));
    EXPECT_FALSE(turns.is_long());
}

TEST(LongTurns, WhoIsLongMostOfTheTimeIsLong) {
    LongTurns turns;
    for (int i = 0; i < 20; ++i) {
        turns.moved(turn_of(i % 3 == 0 ? 1 : 50));
        if (i < 5) continue;
        EXPECT_TRUE(turns.is_long());
    }
}

TEST(LongTurns, WhatIsPreparedForAFrameCountsToo) {
    LongTurns turns;
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 3; ++k)
            turns.prepared(turn_of(10));
        turns.moved(turn_of(1));
    }
    EXPECT_EQ(turns.worked(), 31 * ms);
}

TEST(LongTurns, TheyAreForgottenWhenTheyAreOver) {
    LongTurns turns;
    for (int i = 0; i < 5; ++i)
        turns.moved(turn_of(100));
    for (int i = 0; i < 3; ++i)
        turns.moved(turn_of(1));
    EXPECT_FALSE(turns.is_long());
}

// Once long it has no help: the same work must not count as more then.
TEST(LongTurns, WhoWouldBeShortWithHelpIsNotLongForWantOfIt) {
    LongTurns turns;
    for (int i = 0; i < 2; ++i)
        turns.moved({.took = 100 * ms, .helped = 100 * ms});
    ASSERT_TRUE(turns.is_long());
    for (int i = 0; i < 3; ++i)
        turns.moved({.took = 60 * ms, .helped = 8 * ms});
    EXPECT_FALSE(turns.is_long());
}

}  // namespace
}  // namespace camdir::director
