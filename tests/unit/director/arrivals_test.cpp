#include "director/arrivals.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "stage.hpp"

namespace camdir::director {
namespace {

constexpr std::int64_t interval = 16 * ms;
constexpr std::int64_t first = 1'700'000'000'000 * ms;
constexpr std::int64_t never_too_many = 1'000'000;  // a second

PoseFrame frame_sent(std::int64_t source_time, std::uint64_t epoch = 1) {
    PoseFrame frame;
    frame.epoch = epoch;
    frame.frame_time = source_time - first;
    frame.source_time = source_time;
    return frame;
}

class BurstTest : public testing::Test {
  protected:
    // At 60 Hz, `number` frames after the first one. Whether it is of a burst.
    bool put(std::int64_t number, std::int64_t received_ns) {
        return put_sent(first + number * interval, received_ns);
    }

    bool put_sent(std::int64_t source_time, std::int64_t received_ns, std::uint64_t epoch = 1) {
        return put(frame_sent(source_time, epoch), received_ns);
    }

    bool put(PoseFrame frame, std::int64_t received_ns) {
        const auto receipt = arrivals_->judge(frame, received_ns);
        return receipt.value().in_burst;
    }

    void begin() { arrivals_.emplace(never_too_many); }

    std::optional<Arrivals> arrivals_{never_too_many};
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
        begin();
        std::int64_t number = 0;
        const auto sent = [&] {
            const auto ideal = static_cast<double>(number * interval);
            return first + static_cast<std::int64_t>(ideal * (1.0 + drift));
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
        together += put_sent(first + 3 * number * interval, number * interval) ? 1 : 0;
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
    EXPECT_FALSE(put_sent(first + 2 * interval, 80 * ms, 2)) << "another epoch";
    put_sent(first + 3 * interval, 96 * ms, 2);
    put_sent(first - 3'600'000 * ms, 112 * ms, 2);  // the clock was set back by an hour
    int together = 0;
    for (std::int64_t number = 1; number < 100; ++number)
        together +=
            put_sent(first - 3'600'000 * ms + 3 * number * interval, 112 * ms + number * interval, 2) ? 1 : 0;
    EXPECT_EQ(together, 0) << "of a clock that runs too fast";
}

TEST_F(BurstTest, TakesAnyTime) {
    constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t last = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t sent : {least, last, least, std::int64_t{-1}, last, std::int64_t{1}}) {
        PoseFrame frame;
        frame.source_time = frame.frame_time = sent;
        EXPECT_FALSE(put(std::move(frame), 100 * ms)) << sent;
    }
}

TEST(Arrivals, OfAGameServerThatSendsTooFastSomeFramesAreLetInEvenly) {
    constexpr std::int64_t most = 100;  // a second
    Arrivals arrivals(most);
    std::int64_t let_in = 0, last_let_in = 0, gap = 0;
    for (std::int64_t number = 0; number < 30'000; ++number) {
        const std::int64_t now = number * ms;
        PoseFrame frame = frame_sent(first + now);
        if (!arrivals.judge(frame, now)) continue;
        ++let_in;
        if (number > 20'000) gap = std::max(gap, now - last_let_in);
        last_let_in = now;
    }
    EXPECT_LE(gap, 10 * ms);
    EXPECT_GE(gap, 9 * ms);
    EXPECT_NEAR(static_cast<double>(let_in), 1.02 * 30.0 * most + 1.02 * 4.0 * most, 2.0);
}

TEST(Arrivals, WhatAStallHasHeldUpIsLetIn) {
    Arrivals arrivals(100);
    for (std::int64_t number = 0; number < 6'000; ++number) {
        const std::int64_t sent = number * 10 * ms;
        const std::int64_t stall_begins = number / 2'000 * 20'000 * ms + 10'000 * ms;
        const std::int64_t stall_ends = stall_begins + 9'000 * ms;
        const bool stalled = sent >= stall_begins && sent < stall_ends;
        PoseFrame frame = frame_sent(first + sent);
        EXPECT_TRUE(arrivals.judge(frame, stalled ? stall_ends : sent)) << number;
    }
}

// A game that is paused or slowed down, one that runs on, and a stall of more than 10 s.
TEST_F(BurstTest, IsToldByTheSendersClockAlone) {
    for (const double game_speed : {0.0, 0.5, 1.0})
        for (const std::int64_t held_up : {20, 1000}) {
            begin();
            const auto sent = [&](std::int64_t number) {
                PoseFrame frame = frame_sent(first + number * interval);
                frame.frame_time =
                    static_cast<std::int64_t>(game_speed * static_cast<double>(number * interval));
                return frame;
            };
            for (std::int64_t number = 0; number < 200; ++number)
                EXPECT_FALSE(put(sent(number), number * interval));
            const std::int64_t end = (200 + held_up) * interval;
            EXPECT_FALSE(put(sent(200), end)) << "the first one is only late";
            for (std::int64_t number = 201; number <= 200 + held_up; ++number)
                EXPECT_TRUE(put(sent(number), end)) << game_speed << " " << held_up << " " << number;
        }
}

TEST(Arrivals, NoClockMakesAnHonestMatchWait) {
    for (const double speed : {0.0, 0.001, 0.1, 0.9, 1.1, 100.0}) {
        Arrivals arrivals(100);
        for (std::int64_t number = 0; number < 6'000; ++number) {
            const std::int64_t now = number * interval;
            PoseFrame frame = frame_sent(first + static_cast<std::int64_t>(speed * static_cast<double>(now)));
            ASSERT_TRUE(arrivals.judge(frame, now)) << speed << " " << number;
        }
    }
}

TEST(Arrivals, AtTheVeryLimitNothingIsLeftOut) {
    std::mt19937 random(3);
    Arrivals arrivals(150);
    for (std::int64_t number = 0; number < 1'000'000; ++number) {
        const double sent = static_cast<double>(number) * 1e9 / 150.0 * 0.9999;
        const auto now = static_cast<std::int64_t>(sent) + static_cast<std::int64_t>(random() % 2'000'000);
        PoseFrame frame = frame_sent(first + static_cast<std::int64_t>(sent));
        ASSERT_TRUE(arrivals.judge(frame, now)) << number;
    }
}

TEST(Arrivals, NoClockLetsMoreIn) {
    std::mt19937 random(3);
    for (int run = 0; run < 50; ++run) {
        Arrivals arrivals(100);
        std::int64_t let_in = 0, sent = first, game = 0;
        for (std::int64_t now = 0; now < 20'000 * ms; now += ms) {
            PoseFrame frame = frame_sent(sent);
            frame.frame_time = game;
            let_in += arrivals.judge(frame, now) ? 1 : 0;
            if (random() % 500 == 0) sent += static_cast<std::int64_t>(random() % 20'000) * ms - 10'000 * ms;
            sent += static_cast<std::int64_t>(random() % 3) * ms;
            game += static_cast<std::int64_t>(random() % 3) * ms;
        }
        EXPECT_LE(let_in, 2450);
        EXPECT_GE(let_in, 2440);
    }
}

TEST(Arrivals, ARespawnIsNotLostWithAFrameThatIsLeftOut) {
    Arrivals arrivals(1);
    const auto judge = [&](std::uint64_t epoch, std::uint32_t flags, std::int64_t now) {
        PoseFrame frame;
        frame.epoch = epoch;
        frame.poses.push_back({1, Vec3f::Zero(), Quatf::Identity(), Vec3f::Zero(), flags});
        return arrivals.judge(frame, now) ? std::optional(frame.poses.at(0).flags) : std::nullopt;
    };
    std::int64_t now = 0;
    while (judge(1, pose_alive, now))
        ASSERT_LT(++now, 100);
    EXPECT_FALSE(judge(1, pose_discontinuity, now));
    EXPECT_FALSE(judge(1, pose_alive, now));
    now += 1000 * ms;
    EXPECT_EQ(judge(1, pose_alive, now), pose_alive | pose_discontinuity);
    EXPECT_FALSE(judge(1, pose_discontinuity, now));
    now += 1000 * ms;
    EXPECT_EQ(judge(2, pose_alive, now), pose_alive) << "another epoch's";
    now += 1000 * ms;
    EXPECT_EQ(judge(2, pose_alive, now), pose_alive);
}

}  // namespace
}  // namespace camdir::director
