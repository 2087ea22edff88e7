#include "director/long_turns.hpp"

#include <gtest/gtest.h>

#include "stage.hpp"

namespace camdir::director {
namespace {

// The cameras move in a turn that works for all of its time.
void works(LongTurns& turns, std::int64_t time_ms) {
    turns.moved({time_ms * ms, time_ms * ms, turns.is_suspect() ? time_ms * ms : 0});
}

// In a turn that is held up.
void waits(LongTurns& turns, std::int64_t time_ms) {
    turns.moved({time_ms * ms, time_ms * ms, turns.is_suspect() ? 1 * ms : 0});
}

TEST(LongTurns, ShortOnesAreNoneWhateverTheyFollow) {
    LongTurns turns;
    for (int i = 0; i < 20; ++i) {
        works(turns, i % 5 == 0 ? 60 : 5);
        EXPECT_FALSE(turns.is_long());
        EXPECT_EQ(turns.worked(), 0);
    }
}

TEST(LongTurns, TwoInARowSayAll) {
    LongTurns turns;
    works(turns, 100);
    EXPECT_FALSE(turns.is_long());
    works(turns, 80);
    EXPECT_TRUE(turns.is_long());
    EXPECT_EQ(turns.worked(), 80 * ms);
}

TEST(LongTurns, AVeryLongOneSaysAll) {
    LongTurns turns;
    works(turns, 1);
    works(turns, 500);
    EXPECT_TRUE(turns.is_long());
    EXPECT_EQ(turns.worked(), 1 * ms);
    works(turns, 1);
    EXPECT_FALSE(turns.is_long());
}

// Nobody measures its processor time.
TEST(LongTurns, TheFirstLongOneAfterShortOnesMayHaveWaited) {
    LongTurns turns;
    for (int i = 0; i < 5; ++i)
        works(turns, 1);
    works(turns, 600);
    works(turns, 80);
    EXPECT_FALSE(turns.is_long());
    works(turns, 90);
    EXPECT_TRUE(turns.is_long());
    EXPECT_EQ(turns.worked(), 80 * ms);
}

TEST(LongTurns, AStallIsNone) {
    LongTurns turns;
    for (int i = 0; i < 40; ++i) {
        i % 5 < 2 ? waits(turns, 5000) : works(turns, 19);
        EXPECT_FALSE(turns.is_long());
    }
    works(turns, 30);
    EXPECT_FALSE(turns.is_long()) << "one of 30 ms";
    works(turns, 30);
    EXPECT_TRUE(turns.is_long());
    EXPECT_EQ(turns.worked(), 30 * ms) << "nobody rests for a stall";
}

TEST(LongTurns, WhoeverIsHeldUpFrameAfterFrameIsLong) {
    LongTurns turns;
    for (int round = 0; round < 2; ++round) {
        for (int i = 1; i < 40; ++i)
            waits(turns, 20);
        EXPECT_FALSE(turns.is_long());
        waits(turns, 19);
    }
    for (int i = 1; i <= 50; ++i) {
        waits(turns, 20);
        EXPECT_EQ(turns.is_long(), i >= 40);
    }
}

TEST(LongTurns, ProcessorTimeIsMeasuredAtFirstAndAfterALongOne) {
    LongTurns turns;
    for (int round = 0; round < 2; ++round) {
        for (int i = 0; i < 5; ++i) {
            EXPECT_TRUE(turns.is_suspect()) << i;
            works(turns, 19);
        }
        EXPECT_FALSE(turns.is_suspect());
        waits(turns, 20);
    }
}

TEST(LongTurns, WhoIsLongMostOfTheTimeIsLong) {
    LongTurns turns;
    for (int i = 0; i < 20; ++i) {
        works(turns, i % 3 == 0 ? 1 : 50);
        if (i < 5) continue;
        EXPECT_TRUE(turns.is_long());
    }
}

TEST(LongTurns, WhatIsPreparedForAFrameCountsToo) {
    LongTurns turns;
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 3; ++k)
            turns.prepared({10 * ms, 10 * ms, turns.is_suspect() ? 10 * ms : 0});
        works(turns, 1);
    }
    EXPECT_EQ(turns.worked(), 31 * ms);
}

TEST(LongTurns, TheyAreForgottenWhenTheyAreOver) {
    LongTurns turns;
    for (int i = 0; i < 5; ++i)
        works(turns, 100);
    for (int i = 0; i < 3; ++i)
        works(turns, 1);
    EXPECT_FALSE(turns.is_long());
}

// Once long it has no help: the same work must not count as more then.
TEST(LongTurns, WhoWouldBeShortWithHelpIsNotLongForWantOfIt) {
    LongTurns turns;
    for (int i = 0; i < 2; ++i)
        works(turns, 100);
    ASSERT_TRUE(turns.is_long());
    for (int i = 0; i < 3; ++i)
        turns.moved({.took = 60 * ms, .helped = 8 * ms, .processor = 8 * ms});
    EXPECT_FALSE(turns.is_long());
}

}  // namespace
}  // namespace camdir::director
