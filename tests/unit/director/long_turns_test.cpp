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

TEST(LongTurns, TwoInARowAfterOneThatArousesSuspicionSayAll) {
    LongTurns turns;
    works(turns, 100);
    EXPECT_FALSE(turns.is_long()) << "it may have waited";
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
}

TEST(LongTurns, AStallIsNoneOfTheTwo) {
    LongTurns turns;
    waits(turns, 5000);
    works(turns, 30);
    EXPECT_FALSE(turns.is_long()) << "one of 30 ms";
    works(turns, 30);
    EXPECT_TRUE(turns.is_long());
    EXPECT_EQ(turns.worked(), 30 * ms) << "nobody rests for a stall";
}

TEST(LongTurns, WhoeverIsHeldUpMostOfTheTimeIsLong) {
    LongTurns turns;
    for (int i = 0; i < 10; ++i) {
        waits(turns, 100);
        EXPECT_EQ(turns.is_long(), i >= 2);
    }
    LongTurns brief;
    for (int i = 0; i < 10; ++i) {
        waits(brief, 49);
        EXPECT_FALSE(brief.is_long());
    }
}

TEST(LongTurns, ProcessorTimeIsMeasuredAfterALongOne) {
    LongTurns turns;
    works(turns, 19);
    EXPECT_FALSE(turns.is_suspect());
    works(turns, 20);
    for (int i = 0; i < 5; ++i) {
        EXPECT_TRUE(turns.is_suspect()) << i;
        works(turns, 19);
    }
    EXPECT_FALSE(turns.is_suspect());
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
    for (int i = 0; i < 3; ++i) {
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
    for (int i = 0; i < 3; ++i)
        works(turns, 100);
    ASSERT_TRUE(turns.is_long());
    for (int i = 0; i < 3; ++i)
        turns.moved({.took = 60 * ms, .helped = 8 * ms, .processor = 8 * ms});
    EXPECT_FALSE(turns.is_long());
}

}  // namespace
}  // namespace camdir::director
