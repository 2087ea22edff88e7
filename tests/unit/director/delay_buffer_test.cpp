#include "director/delay_buffer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "director/arrivals.hpp"
#include "stage.hpp"

namespace camdir::director {
namespace {

using Admission = DelayBuffer::Admission;
using testing::HasSubstr;

constexpr std::int64_t one_s = 1000 * ms;

PoseFrame frame_at(std::uint32_t number, std::int64_t frame_time, std::uint64_t epoch = 1) {
    PoseFrame frame;
    frame.epoch = epoch;
    frame.frame_number = number;
    frame.frame_time = frame_time;
    frame.poses.resize(4);
    return frame;
}

class DelayBufferTest : public testing::Test {
  protected:
    Admission put(std::uint32_t number, std::int64_t now, std::uint64_t epoch = 1) {
        return buffer_.put(frame_at(number, number * 20 * ms, epoch), now);
    }
    // As punctual as its sender's clock says.
    Admission put_judged(PoseFrame& frame, std::int64_t now) {
        return buffer_.put(frame, arrivals_.judge(frame, now).value().punctual);
    }
    Admission put(Message message, std::int64_t now) { return buffer_.put(message, now); }

    // What leaves at this time; `next_due_` is set.
    const Inbox::Content& release(std::int64_t now) {
        buffer_.release(now, inbox_);
        next_due_ = buffer_.state().next_due;
        inbox_.take(content_);
        return content_;
    }

    MatchCounters counters_;
    Pace pace_;
    Arrivals arrivals_{1000};
    Inbox inbox_{pace_, counters_};
    Inbox::Content content_;
    std::int64_t next_due_ = 0;
    DelayBuffer buffer_{1U << 20U};
};

TEST_F(DelayBufferTest, WithoutADelayNothingIsKept) {
    EXPECT_FALSE(buffer_.announce(1, 0.0, 0));
    EXPECT_EQ(put(MatchInfo{}, 0), Admission::undelayed);
    EXPECT_EQ(put(1, 0), Admission::undelayed);
    EXPECT_FALSE(release(one_s).has_frame);
    std::uint64_t position = 0;
    EXPECT_FALSE(buffer_.look_ahead(position, [](const PoseFrame&) { return true; }));
}

TEST_F(DelayBufferTest, NothingLeavesEarlyOrMuchLater) {
    std::mt19937 random(7);
    std::uniform_int_distribution<std::int64_t> jitter(0, 60 * ms);
    buffer_.announce(1, 2.0, 0);
    std::vector<std::int64_t> received;
    std::int64_t now = 0;
    for (std::uint32_t number = 0; number < 200; ++number) {
        now = std::max(now, number * 20 * ms + jitter(random));
        received.push_back(now);
        ASSERT_EQ(put(number, now), Admission::delayed);
    }
    std::uint32_t next = 0;
    for (std::int64_t time = 0; next < 200 && time < 10 * one_s; time += ms) {
        if (!release(time).has_frame) continue;
        ASSERT_EQ(content_.frame.frame_number, next) << "in order, one by one";
        EXPECT_GE(time, received[next] + 2 * one_s);
        EXPECT_LT(time, received[next] + 2 * one_s + 251 * ms);
        EXPECT_LE(content_.received_ns, time);
        EXPECT_GT(content_.received_ns, time - ms) << "when it was due";
        ++next;
    }
    EXPECT_EQ(next, 200U);
    EXPECT_EQ(next_due_, DelayBuffer::never);
}

// Whatever frames are late on their way leave as regularly as they were sent.
TEST_F(DelayBufferTest, TheDelayTakesOutWhatTheWayAdds) {
    constexpr std::int64_t other_clock = -7'000'000'000'000;
    constexpr std::int64_t fastest = 2 * ms;
    std::mt19937 random(7);
    std::uniform_int_distribution<std::int64_t> jitter(0, 60 * ms);
    buffer_.announce(1, 2.0, 0);
    std::int64_t received = 0;
    for (std::uint32_t number = 0; number < 2'000; ++number) {
        const std::int64_t sent = number * 20 * ms;
        received =
            std::max(received, sent + fastest + (number % 100 < 95 && number > 0 ? jitter(random) : 0));
        PoseFrame frame = frame_at(number, sent);
        frame.source_time = other_clock + sent;
        ASSERT_EQ(put_judged(frame, received), Admission::delayed);
        const std::int64_t due = sent + fastest + 2 * one_s;
        EXPECT_FALSE(release(due - 1).has_frame) << number;
        ASSERT_TRUE(release(due).has_frame) << number;
        EXPECT_EQ(content_.frame.frame_number, number);
        EXPECT_EQ(content_.received_ns, due);
    }
}

// The director stood still, or the network: it is seen once, when it happens, and not in what leaves later.
TEST_F(DelayBufferTest, WhatWaitedInAStallLeavesAsItWasSent) {
    buffer_.announce(1, 4.0, 0);
    for (std::uint32_t number = 1; number < 400; ++number) {
        const std::int64_t sent = number * 20 * ms;
        const bool stalled = sent >= one_s && sent < 3 * one_s;
        PoseFrame frame = frame_at(number, sent);
        frame.source_time = sent;
        ASSERT_EQ(put_judged(frame, stalled ? 3 * one_s : sent), Admission::delayed);
    }
    for (std::uint32_t number = 1; number < 400; ++number) {
        const std::int64_t due = number * 20 * ms + 4 * one_s;
        EXPECT_FALSE(release(due - 1).has_frame) << number;
        ASSERT_TRUE(release(due).has_frame) << number;
        EXPECT_EQ(content_.frame.frame_number, number);
    }
}

// A clock that goes back a little with every frame is no stall that grows.
TEST_F(DelayBufferTest, AClockThatCreepsBackMakesNothingEarlierThanJitterMay) {
    buffer_.announce(1, 4.0, 0);
    int left = 0;
    for (std::int64_t number = 1; number < 600; ++number) {
        const std::int64_t now = number * 20 * ms;
        PoseFrame frame = frame_at(static_cast<std::uint32_t>(number), now);
        frame.source_time = 1000 * one_s + now - number * 90 * ms;
        ASSERT_EQ(put_judged(frame, now), Admission::delayed);
        if (!release(now).has_frame) continue;
        ++left;
        EXPECT_LE(content_.frame.frame_number * 20 * ms, now - 4 * one_s + 100 * ms);
    }
    EXPECT_GT(left, 300);
}

TEST_F(DelayBufferTest, NoClockOfASenderMakesFramesEarly) {
    constexpr std::int64_t limit = std::numeric_limits<std::int64_t>::max();
    std::mt19937_64 random(11);
    buffer_.announce(1, 2.0, 0);
    std::int64_t offset = 0;
    for (std::uint32_t number = 1; number < 3'000; ++number) {
        const std::int64_t now = number * 20 * ms;
        switch (random() % 50) {
            case 0:
                offset = static_cast<std::int64_t>(random());
                break;
            case 1:
                offset = random() % 2 == 0 ? limit : -limit;
                break;
            case 2:
                offset = 3600 * one_s;
                break;
            default:
                break;
        }
        PoseFrame frame = frame_at(number, now);
        frame.source_time =
            static_cast<std::int64_t>(static_cast<std::uint64_t>(now) + static_cast<std::uint64_t>(offset));
        ASSERT_EQ(put_judged(frame, now), Admission::delayed);
        const std::int64_t due = now + 2 * one_s;
        EXPECT_FALSE(release(due - 1).has_frame) << number;
        ASSERT_TRUE(release(due).has_frame) << number;
    }
}

TEST_F(DelayBufferTest, FramesAndMessagesKeepTheirOrder) {
    buffer_.announce(1, 1.0, 0);
    put(MatchInfo{}, 0);
    put(0, 10 * ms);
    put(MatchEvent{}, 20 * ms);
    put(1, 30 * ms);
    put(MatchEnded{}, 40 * ms);
    EXPECT_TRUE(release(one_s - 1).messages.empty());
    EXPECT_EQ(next_due_, one_s);
    EXPECT_TRUE(std::holds_alternative<MatchInfo>(release(one_s).messages.at(0)));
    EXPECT_EQ(release(one_s + 10 * ms).frame.frame_number, 0U);
    EXPECT_TRUE(std::holds_alternative<MatchEvent>(release(one_s + 20 * ms).messages.at(0)));
    EXPECT_EQ(release(one_s + 30 * ms).frame.frame_number, 1U);
    EXPECT_TRUE(std::holds_alternative<MatchEnded>(release(one_s + 40 * ms).messages.at(0)));
    EXPECT_EQ(next_due_, DelayBuffer::never);
}

TEST_F(DelayBufferTest, ABurstLeavesAtThePaceOfTheGame) {
    buffer_.announce(1, 1.0, 0);
    for (std::uint32_t number = 0; number < 6; ++number)
        put(number, 0);
    std::int64_t last = 0;
    for (std::uint32_t number = 0; number < 6; ++number) {
        release(number == 0 ? one_s : next_due_);
        EXPECT_EQ(content_.frame.frame_number, number);
        if (number > 0) {
            EXPECT_EQ(content_.received_ns - last, 18 * ms);
        }
        last = content_.received_ns;
    }
    // No drift: punctual frames catch up.
    for (std::uint32_t number = 6; number < 60; ++number)
        put(number, number * 20 * ms);
    while (release(last), next_due_ != DelayBuffer::never)
        last = next_due_;
    EXPECT_EQ(last, 59 * 20 * ms + one_s);
}

TEST_F(DelayBufferTest, NoClockOfAGameHoldsUpItsFrames) {
    constexpr std::int64_t limits[] = {std::numeric_limits<std::int64_t>::min(), 0,
                                       std::numeric_limits<std::int64_t>::max()};
    buffer_.announce(1, 1.0, 0);
    for (int i = 0; i < 300; ++i) {
        const std::int64_t now = i * 20 * ms;
        const bool wild = i % 10 == 0;
        ASSERT_EQ(buffer_.put(
                      frame_at(static_cast<std::uint32_t>(i), wild ? limits[i / 10 % 3] : i * 200 * ms), now),
                  Admission::delayed);
        release(now);
        if (next_due_ != DelayBuffer::never) {
            EXPECT_LE(next_due_, now + one_s);
        }
    }
    EXPECT_TRUE(release(299 * 20 * ms + one_s + 250 * ms).has_frame);
    while (release(299 * 20 * ms + one_s + 250 * ms).has_frame) {
    }
    EXPECT_EQ(next_due_, DelayBuffer::never);
}

TEST_F(DelayBufferTest, AfterAShortStallFramesAreShownInTurn) {
    buffer_.announce(1, 1.0, 0);
    for (std::uint32_t number = 0; number < 50; ++number)
        put(number, number * 20 * ms);
    for (std::uint32_t number = 0; number <= 5; ++number) {
        ASSERT_TRUE(release(one_s + 5 * 20 * ms).has_frame);
        EXPECT_EQ(content_.frame.frame_number, number);
    }
    EXPECT_FALSE(release(one_s + 5 * 20 * ms).has_frame);
    EXPECT_EQ(next_due_, one_s + 6 * 20 * ms);
}

TEST_F(DelayBufferTest, AfterALongStallFramesThatAreTooLateAreLeftOut) {
    buffer_.announce(1, 1.0, 0);
    put(MatchEvent{}, 0);
    for (std::uint32_t number = 0; number < 50; ++number)
        put(number, number * 20 * ms);
    put(MatchEvent{}, 49 * 20 * ms);
    for (std::uint32_t number = 25; number <= 30; ++number) {
        ASSERT_TRUE(release(one_s + 30 * 20 * ms).has_frame);
        EXPECT_EQ(content_.frame.frame_number, number);
        EXPECT_EQ(content_.messages.size(), number == 25 ? 1U : 0U);
    }
    EXPECT_FALSE(release(one_s + 30 * 20 * ms).has_frame);
    EXPECT_EQ(next_due_, one_s + 31 * 20 * ms);
    release(100 * one_s);
    EXPECT_EQ(content_.frame.frame_number, 49U);
    EXPECT_EQ(content_.messages.size(), 1U);
}

TEST_F(DelayBufferTest, TurnsThatAreTooSlowDoNotMakeFramesEverLater) {
    buffer_.announce(1, 1.0, 0);
    for (std::uint32_t number = 0; number < 500; ++number)
        put(number, number * 20 * ms);
    int shown = 0;
    for (std::int64_t now = one_s; now < 11 * one_s; now += ms) {
        buffer_.release(now, inbox_);
        if (now % (25 * ms) != 0) continue;
        inbox_.take(content_);
        ASSERT_TRUE(content_.has_frame);
        ASSERT_GE(content_.received_ns, now - 130 * ms);
        ++shown;
    }
    EXPECT_EQ(shown, 400);
}

// Or the pace would take each second with them for a hiccup.
TEST_F(DelayBufferTest, OfTurnsThatAreALittleTooSlowSomeFramesAreLeftOutInEverySecond) {
    buffer_.announce(1, 1.0, 0);
    for (std::uint32_t number = 0; number < 1000; ++number)
        put(number, number * 20 * ms);
    Statistics before;
    for (std::int64_t now = one_s; now < 20 * one_s; now += ms) {
        buffer_.release(now, inbox_);
        if (now % (21 * ms) == 0) inbox_.take(content_);
        if (now % one_s != 0) continue;
        Statistics sum;
        counters_.add_to(sum);
        const auto lost = sum[Counter::drop_superseded] - before[Counter::drop_superseded];
        if (now > 5 * one_s) {
            EXPECT_GE(lost, 2U) << now / one_s;
        }
        before = sum;
    }
}

// Frames wait in the buffer, however punctual the turns were before.
TEST_F(DelayBufferTest, AStallOfTurnsLosesWhatIsTooLateAlone) {
    buffer_.announce(1, 1.0, 0);
    for (std::uint32_t number = 0; number < 200; ++number)
        put(number, number * 20 * ms);
    for (std::uint32_t number = 0; number <= 150; ++number)
        ASSERT_EQ(release(one_s + number * 20 * ms).frame.frame_number, number);
    const std::int64_t begun = one_s + 151 * 20 * ms;
    const std::int64_t ended = begun + 110 * ms;
    for (std::int64_t now = begun; now <= ended; now += 5 * ms)
        buffer_.release(now, inbox_);
    for (std::uint32_t number = 152; number <= 156; ++number) {
        inbox_.take(content_);
        ASSERT_TRUE(content_.has_frame);
        EXPECT_EQ(content_.frame.frame_number, number);
        EXPECT_GE(content_.received_ns, ended - 100 * ms);
        buffer_.release(ended, inbox_);
    }
    Statistics sum;
    counters_.add_to(sum);
    EXPECT_EQ(sum[Counter::drop_superseded], 1U);
}

TEST_F(DelayBufferTest, AFrameWaitsUntilTheOneBeforeIsTaken) {
    buffer_.announce(1, 1.0, 0);
    put(0, 0);
    put(1, 20 * ms);
    put(2, 300 * ms);
    const std::int64_t now = one_s + 30 * ms;
    EXPECT_TRUE(buffer_.release(now, inbox_).any);
    const auto again = buffer_.release(now, inbox_);
    EXPECT_GT(again.next, now) << "or whoever waits for it would not wait";
    EXPECT_LE(again.next, now + 5 * ms);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.frame_number, 0U);
    EXPECT_EQ(release(now).frame.frame_number, 1U);
    EXPECT_EQ(buffer_.release(now, inbox_).next, one_s + 300 * ms - DelayBuffer::lead_ns);
}

TEST_F(DelayBufferTest, ADeadGameServerHasItsLastSeconds) {
    buffer_.announce(1, 3.0, 0);
    for (std::uint32_t number = 0; number < 100; ++number)
        put(number, number * 20 * ms);
    put(ServerLost{}, 4 * one_s);
    int shown = 0;
    for (std::int64_t now = 2 * one_s; now < 7 * one_s; now += 20 * ms) {
        shown += release(now).has_frame ? 1 : 0;
        EXPECT_TRUE(content_.messages.empty());
    }
    EXPECT_EQ(shown, 100);
    EXPECT_TRUE(std::holds_alternative<ServerLost>(release(7 * one_s).messages.at(0)));
}

TEST_F(DelayBufferTest, AGrowingDelayHoldsBackWhatWaits) {
    EXPECT_TRUE(buffer_.announce(1, 1.0, 0));
    EXPECT_EQ(buffer_.state().resumes_at, one_s);
    put(0, 0);
    put(1, 500 * ms);
    EXPECT_TRUE(release(one_s).has_frame);
    EXPECT_TRUE(buffer_.announce(1, 3.0, one_s));
    EXPECT_EQ(buffer_.state().resumes_at, 3500 * ms);
    put(2, 1100 * ms);
    EXPECT_FALSE(release(3499 * ms).has_frame);
    EXPECT_EQ(release(3500 * ms).frame.frame_number, 1U);
    EXPECT_EQ(release(4100 * ms).frame.frame_number, 2U);

    EXPECT_FALSE(buffer_.set_minimum(3.0, 5 * one_s)) << "not greater than the match's own";
    EXPECT_TRUE(buffer_.set_minimum(5.0, 5 * one_s));
    EXPECT_EQ(buffer_.state().resumes_at, 10 * one_s) << "nothing waits";
    EXPECT_EQ(buffer_.state().delay_s, 5.0);
}

TEST_F(DelayBufferTest, AShorterDelayWaitsForTheNextEpoch) {
    buffer_.announce(1, 10.0, 0);
    put(0, 0);
    EXPECT_FALSE(buffer_.announce(1, 1.0, 0));
    put(1, 20 * ms);
    EXPECT_FALSE(buffer_.announce(2, 1.0, 100 * ms));
    put(MatchInfo{}, 100 * ms);
    put(0, 200 * ms, 2);
    EXPECT_FALSE(buffer_.announce(1, 0.0, 300 * ms)) << "of an old epoch";
    EXPECT_FALSE(release(10 * one_s - 1).has_frame);
    EXPECT_EQ(release(10 * one_s).frame.frame_number, 0U);
    release(10 * one_s + 20 * ms);
    EXPECT_EQ(content_.messages.size(), 1U) << "the next epoch begins when this one is over";
    EXPECT_EQ(content_.frame.epoch, 2U);
    put(1, 20 * one_s, 2);
    EXPECT_FALSE(release(21 * one_s - 1).has_frame);
    EXPECT_TRUE(release(21 * one_s).has_frame);
}

TEST_F(DelayBufferTest, FramesThatAreDueTogetherAreShownAsOne) {
    buffer_.announce(1, 10.0, 0);
    put(0, 0);
    buffer_.announce(2, 1.0, 100 * ms);
    for (std::uint32_t number = 0; number < 50; ++number)
        put(number, (200 + 20 * number) * ms, 2);
    release(10 * one_s);
    EXPECT_EQ(content_.frame.epoch, 2U);
    EXPECT_EQ(content_.frame.frame_number, 49U) << "all waited for the epoch before";
}

TEST_F(DelayBufferTest, ATooLongDelayIsRefused) {
    buffer_.announce(1, 1.0, 0);
    put(0, 0);
    EXPECT_TRUE(buffer_.announce(1, 120.5, ms));
    EXPECT_EQ(buffer_.state().refusal, "a delay of 120.5 s is wanted; the longest possible is 120 s");
    EXPECT_FALSE(buffer_.announce(1, 120.5, ms)) << "observers know it";
    EXPECT_EQ(put(1, 2 * ms), Admission::refused);
    EXPECT_EQ(put(MatchEvent{}, 2 * ms), Admission::refused);
    EXPECT_EQ(put(MatchInfo{}, 2 * ms), Admission::refused);
    EXPECT_FALSE(release(1000 * one_s).has_frame) << "neither what waited";

    EXPECT_TRUE(buffer_.announce(1, 120.0, 1000 * one_s));
    EXPECT_EQ(buffer_.state().refusal, "");
    EXPECT_EQ(buffer_.state().resumes_at, 1120 * one_s);
    EXPECT_EQ(put(2, 1000 * one_s), Admission::delayed);
    EXPECT_TRUE(buffer_.announce(2, 1e30, 1001 * one_s));
    EXPECT_EQ(put(MatchEnded{}, 1001 * one_s), Admission::undelayed);
    EXPECT_EQ(buffer_.state().refusal, "");
    EXPECT_FALSE(release(2000 * one_s).has_frame);
}

TEST_F(DelayBufferTest, ADelayThatNeedsTooMuchMemoryIsRefused) {
    buffer_.announce(1, 100.0, 0);
    std::uint32_t number = 0;
    Admission last = Admission::delayed;
    while (last == Admission::delayed && number < 10000) {
        last = put(number, number * 20 * ms);
        ++number;
        EXPECT_LE(buffer_.state().bytes, 1U << 20U);
    }
    EXPECT_EQ(last, Admission::refused_now);
    EXPECT_GT(number, 1000U);
    EXPECT_THAT(buffer_.state().refusal, HasSubstr("needs more memory than limits.delay_mib, 1 MiB"));
    EXPECT_EQ(buffer_.state().bytes, 0U);
    EXPECT_EQ(put(number, 0), Admission::refused);
    EXPECT_FALSE(buffer_.announce(1, 100.0, 0)) << "the same would happen again";
    EXPECT_EQ(put(number, 0), Admission::refused);
    EXPECT_TRUE(buffer_.announce(1, 20.0, 0));
    EXPECT_EQ(put(number, 0), Admission::delayed);
    EXPECT_EQ(buffer_.state().next_due, 20 * one_s) << "what was dropped holds nothing up";
}

TEST_F(DelayBufferTest, EveryEpochHearsThatItIsRefused) {
    EXPECT_TRUE(buffer_.announce(1, 150.0, 0));
    EXPECT_FALSE(buffer_.announce(1, 150.0, 0));
    EXPECT_TRUE(buffer_.announce(2, 150.0, 0));
}

TEST_F(DelayBufferTest, TheEndOfAMatchAlwaysFitsIn) {
    buffer_.announce(1, 100.0, 0);
    std::uint32_t number = 0;
    while (buffer_.state().bytes + 1024 < 1U << 20U)
        ASSERT_EQ(put(number++, 0), Admission::delayed);
    while (buffer_.state().bytes + 1024 < (1U << 20U) + 4096)
        ASSERT_EQ(put(ServerLost{}, 0), Admission::delayed);
    EXPECT_EQ(put(MatchEnded{}, 0), Admission::delayed);
    EXPECT_EQ(put(number, 0), Admission::refused_now);
}

TEST_F(DelayBufferTest, AGreaterMinimumHoldsBackTheEndOfAnEndedMatch) {
    buffer_.announce(1, 2.0, 0);
    put(0, 0);
    put(MatchEnded{}, 0);
    EXPECT_TRUE(buffer_.set_minimum(60.0, one_s));
    EXPECT_EQ(buffer_.state().next_due, 60 * one_s);
}

TEST_F(DelayBufferTest, ItsMemoryIsBoundedByTheDelay) {
    buffer_.announce(1, 2.0, 0);
    std::size_t largest = 0;
    for (std::uint32_t number = 0; number < 3000; ++number) {
        ASSERT_EQ(put(number, number * 20 * ms), Admission::delayed);
        release(number * 20 * ms);
        largest = std::max(largest, buffer_.state().bytes);
    }
    const std::size_t of_a_frame = buffer_.state().bytes / 150;  // 2 s that wait, and 1 s that has left
    EXPECT_LE(largest, 152 * of_a_frame);
    release(1000 * one_s);
    EXPECT_EQ(buffer_.state().bytes, 0U);
}

TEST_F(DelayBufferTest, MoversTakeMemoryWhereTheyAreElsewhereThanBefore) {
    buffer_.announce(1, 2.0, 0);
    MoverFrame places;
    places.poses.resize(100);
    const auto movers = [&] {
        return std::make_shared<const MatchMovers>(
            MatchMovers{std::make_shared<MoverInfo>(), std::make_shared<MoverFrame>(places)});
    };
    std::uint32_t number = 0;
    const auto bytes_with = [&](std::shared_ptr<const MatchMovers> among) {
        PoseFrame frame = Stage::poses(number++);
        frame.movers = std::move(among);
        const std::size_t before = buffer_.state().bytes;
        EXPECT_EQ(buffer_.put(frame, 0), Admission::delayed);
        return buffer_.state().bytes - before;
    };
    const std::size_t without = bytes_with(nullptr);
    const auto resting = movers();
    EXPECT_GE(bytes_with(resting), without + 100 * sizeof(MoverPose));
    EXPECT_EQ(bytes_with(resting), without);
    EXPECT_GE(bytes_with(movers()), without + 100 * sizeof(MoverPose));
}

TEST_F(DelayBufferTest, WhatIsToComeCanBeRead) {
    buffer_.announce(1, 1.0, 0);
    for (std::uint32_t number = 0; number < 30; ++number)
        put(number, number * 20 * ms);
    put(MatchEvent{}, one_s);
    release(one_s);
    std::uint64_t position = 0;
    std::vector<std::uint32_t> read;
    const auto until = [&](std::uint32_t limit) {
        return buffer_.look_ahead(position, [&](const PoseFrame& frame) {
            if (frame.frame_number > limit) return false;
            read.push_back(frame.frame_number);
            return true;
        });
    };
    EXPECT_TRUE(until(2));
    EXPECT_EQ(read, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_TRUE(until(3));
    EXPECT_EQ(read.size(), 4U);
    release(2 * one_s + 5 * 20 * ms + 1);
    EXPECT_TRUE(until(100));
    EXPECT_EQ(read.size(), 4U + 24U) << "frames 4 and 5 have left more than a second ago";
    EXPECT_TRUE(until(100));
    EXPECT_EQ(read.size(), 28U);
}

}  // namespace
}  // namespace camdir::director
