#include "director/burst.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "stage.hpp"

namespace camdir::director {
namespace {

class BurstTest : public testing::Test {
  protected:
    // At 60 Hz, `number` frames after the first one.
    bool put(std::int64_t number, std::int64_t received_ns) {
        return put_sent(first_ + number * interval, received_ns);
    }

    bool put_sent(std::int64_t source_time, std::int64_t received_ns, std::uint64_t epoch = 1) {
        PoseFrame frame;
        frame.epoch = epoch;
        frame.source_time = source_time;
        return burst_.goes_on_with(frame, received_ns);
    }

    static constexpr std::int64_t interval = 16 * ms;
    static constexpr std::int64_t first_ = 1'700'000'000'000 * ms;
    Burst burst_;
};

TEST_F(BurstTest, IsWhatWasHeldUp) {
    for (std::int64_t number = 0; number < 20; ++number)
        EXPECT_FALSE(put(number, number * interval)) << number;
    EXPECT_FALSE(put(20, 23 * interval)) << "the first one is only late";
    for (std::int64_t number = 21; number <= 23; ++number)
        EXPECT_TRUE(put(number, 23 * interval + number)) << number;
    EXPECT_FALSE(put(24, 24 * interval));
}

TEST_F(BurstTest, IsToldByTheMostPunctualFrame) {
    put(0, 60 * ms);  // the others are faster
    for (std::int64_t number = 1; number < 20; ++number)
        put(number, number * interval);
    put(20, 21 * interval + 1);
    EXPECT_TRUE(put(21, 21 * interval + 2));
}

TEST_F(BurstTest, MayEndWithAFrameThatIsALittleFaster) {
    for (std::int64_t number = 0; number < 20; ++number)
        put(number, number * interval);
    put(20, 21 * interval - 2 * ms);
    EXPECT_TRUE(put(21, 21 * interval - 2 * ms));
}

TEST_F(BurstTest, IsToldThoughClocksDrift) {
    for (const double drift : {1e-4, -1e-4}) {
        burst_ = {};
        std::int64_t number = 0;
        const auto sent = [&] {
            const auto ideal = static_cast<double>(number * interval);
            return first_ + static_cast<std::int64_t>(ideal * (1.0 + drift));
        };
        for (; number < 40'000; ++number)  // 10 minutes
            EXPECT_FALSE(put_sent(sent(), number * interval));
        const std::int64_t stalled_until = (number + 2) * interval;
        EXPECT_FALSE(put_sent(sent(), stalled_until));
        ++number;
        EXPECT_TRUE(put_sent(sent(), stalled_until)) << drift;
    }
}

TEST_F(BurstTest, IsNotWhatIsAlwaysLate) {
    put(0, 0);
    for (std::int64_t number = 1; number < 100; ++number)
        EXPECT_FALSE(put(number, 50 * ms + number * interval + number % 5 * ms)) << number;
}

TEST_F(BurstTest, IsNoneOfAClockThatRunsTooFast) {
    int together = 0;
    for (std::int64_t number = 0; number < 1000; ++number)
        together += put_sent(first_ + 3 * number * interval, number * interval) ? 1 : 0;
    EXPECT_EQ(together, 0);
}

TEST_F(BurstTest, HasNoMoreFramesThanTheTimeThatPassedAllows) {
    // Frames of 16 ms, a thousand a second.
    int together = 0;
    for (std::int64_t number = 0; number < 10'000; ++number)
        together += put(number, number * ms) ? 1 : 0;
    EXPECT_EQ(together, 0);
}

TEST_F(BurstTest, IsNoneWithoutTheSendersClock) {
    for (std::int64_t number = 0; number < 5; ++number)
        EXPECT_FALSE(put_sent(0, 100 * ms));
    EXPECT_FALSE(put(0, 100 * ms));
    EXPECT_FALSE(put_sent(0, 100 * ms));
    EXPECT_FALSE(put(1, 100 * ms)) << "0 is no time";
}

TEST_F(BurstTest, BeginsAnewWithAnEpochAndWithTheSendersClock) {
    put(0, 0);
    put(1, 80 * ms);
    EXPECT_FALSE(put_sent(first_ + 2 * interval, 80 * ms, 2)) << "another epoch";
    put_sent(first_ + 3 * interval, 96 * ms, 2);
    put_sent(first_ - 3'600'000 * ms, 112 * ms, 2);  // the clock was set back by an hour
    int together = 0;
    for (std::int64_t number = 1; number < 100; ++number)
        together += put_sent(first_ - 3'600'000 * ms + 3 * number * interval, 112 * ms + number * interval, 2)
                        ? 1
                        : 0;
    EXPECT_EQ(together, 0) << "of a clock that runs too fast";
}

TEST_F(BurstTest, TakesAnyTime) {
    constexpr std::int64_t first = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t last = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t sent : {first, last, first, std::int64_t{-1}, last, std::int64_t{1}})
        EXPECT_FALSE(put_sent(sent, 100 * ms)) << sent;
}

}  // namespace
}  // namespace camdir::director
