#include "director/long_turns.hpp"

#include <gtest/gtest.h>

#include "stage.hpp"

namespace camdir::director {
namespace {

TEST(LongTurns, ShortOnesAreNoneWhateverTheyFollow) {
    LongTurns turns;
    for (int i = 0; i < 20; ++i) {
        turns.add(i % 5 == 0 ? 60 * ms : 5 * ms, true);
        EXPECT_EQ(turns.usual(), 0);
    }
}

TEST(LongTurns, TwoInARowSayAll) {
    LongTurns turns;
    turns.add(100 * ms, true);
    EXPECT_EQ(turns.usual(), 0);
    turns.add(80 * ms, true);
    EXPECT_EQ(turns.usual(), 80 * ms);
    EXPECT_EQ(turns.interval(), 160 * ms);
}

TEST(LongTurns, AVeryLongOneSaysSomethingAtOnce) {
    LongTurns turns;
    turns.add(4000 * ms, true);
    EXPECT_EQ(turns.usual(), 500 * ms);
}

TEST(LongTurns, WhoIsLongMostOfTheTimeIsLong) {
    LongTurns turns;
    for (int i = 0; i < 20; ++i) {
        turns.add(i % 3 == 0 ? 1 * ms : 50 * ms, true);
        if (i < 5) continue;
        EXPECT_EQ(turns.usual(), 50 * ms);
    }
}

TEST(LongTurns, WhatIsPreparedForAFrameCountsToo) {
    LongTurns turns;
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 3; ++k)
            turns.add(10 * ms, false);
        turns.add(1 * ms, true);
    }
    EXPECT_EQ(turns.usual(), 31 * ms);
}

TEST(LongTurns, TheyAreForgottenWhenTheyAreOver) {
    LongTurns turns;
    for (int i = 0; i < 5; ++i)
        turns.add(100 * ms, true);
    for (int i = 0; i < 3; ++i)
        turns.add(1 * ms, true);
    EXPECT_EQ(turns.usual(), 0);
}

}  // namespace
}  // namespace camdir::director
