#include "director/inbox.hpp"

#include <gtest/gtest.h>

#include "director/arrivals.hpp"
#include "stage.hpp"

namespace camdir::director {
namespace {

PoseFrame frame(std::uint64_t epoch, std::uint32_t number, std::uint32_t flags = pose_alive) {
    PoseFrame frame;
    frame.epoch = epoch;
    frame.frame_number = number;
    frame.poses.push_back({1, Vec3f::Zero(), Quatf::Identity(), Vec3f::Zero(), flags});
    return frame;
}

MatchInfo info_on(const std::string& map_name, std::uint64_t epoch) {
    MatchInfo info = Stage::info("m", epoch);
    info.map_name = map_name;
    return info;
}

class InboxTest : public testing::Test {
  protected:
    [[nodiscard]] std::uint64_t counted(Counter counter) const {
        Statistics sum;
        counters_.add_to(sum);
        return sum[counter];
    }

    // Of frames, for whatever reason.
    [[nodiscard]] std::uint64_t dropped() const {
        return counted(Counter::drop_superseded) + counted(Counter::drop_burst) +
               counted(Counter::drop_paced) + counted(Counter::drop_old_frame) +
               counted(Counter::drop_old_epoch);
    }

    bool put(PoseFrame frame, std::int64_t received_ns) { return inbox_.put(frame, received_ns); }

    void put_sent_at(std::uint32_t number, std::int64_t sent_ns, std::int64_t received_ns,
                     std::uint32_t flags = 0) {
        PoseFrame sent = frame(1, number, flags);
        put_sent_at(std::move(sent), sent_ns, received_ns);
    }

    void put_sent_at(PoseFrame frame, std::int64_t sent_ns, std::int64_t received_ns) {
        frame.frame_time = sent_ns;
        frame.source_time = 1000 * ms + sent_ns;
        const auto receipt = arrivals_.judge(frame, received_ns);
        ASSERT_TRUE(receipt);
        inbox_.put(frame, receipt->received,
                   receipt->in_burst ? Inbox::Arrival::in_burst : Inbox::Arrival::alone);
    }

    // A frame that tells how long they are on their way.
    void begin_punctually() {
        put_sent_at(0, 0, 0);
        inbox_.take(content_);
        ASSERT_TRUE(content_.has_frame);
    }

    void take_all() {
        do
            inbox_.take(content_);
        while (content_.leaves_more);
    }

    // Frames 0 to 40 are taken in time; 41 to 43 come together, and then 44.
    void put_one_behind_a_burst() {
        for (std::int64_t i = 0; i <= 40; ++i) {
            put_sent_at(static_cast<std::uint32_t>(i), 33 * ms * i, 33 * ms * i);
            inbox_.take(content_);
        }
        for (std::int64_t i = 41; i <= 43; ++i)
            put_sent_at(static_cast<std::uint32_t>(i), 33 * ms * i, 33 * ms * 43);
        put_sent_at(44, 33 * ms * 44, 33 * ms * 44);
    }

    void slow_down_to(std::uint32_t frames_per_camera) {
        const std::uint64_t superseded = frames_per_camera == 2 ? 70 : 200;
        for (int interval = 0; interval < 3; ++interval)
            pace_.observe({.taken = 200, .superseded = superseded, .busy = 1.0});
        ASSERT_EQ(pace_.frames_per_camera(), frames_per_camera);
    }

    MatchCounters counters_;
    Pace pace_;
    Arrivals arrivals_{1000};
    Inbox inbox_{pace_, counters_};
    Inbox::Content content_;
};

TEST_F(InboxTest, MessagesKeepTheirOrderBehindThoseOfObservers) {
    inbox_.put(MatchInfo{});
    inbox_.put(MatchEvent{});
    inbox_.put(MatchRefused{});
    inbox_.put(Stage::request("anna"));
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 4U);
    EXPECT_EQ(std::get<ObserverRequest>(content_.messages[0]).observer_id, "anna");
    EXPECT_TRUE(std::holds_alternative<MatchInfo>(content_.messages[1]));
    EXPECT_TRUE(std::holds_alternative<MatchRefused>(content_.messages[3]));
    EXPECT_FALSE(content_.has_frame);
    inbox_.take(content_);
    EXPECT_TRUE(content_.messages.empty());
}

TEST_F(InboxTest, TheNewestFrameWins) {
    put(frame(1, 1), 10);
    put(frame(1, 3), 30);
    put(frame(1, 2), 20);
    inbox_.take(content_);
    EXPECT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.frame.frame_number, 3U);
    EXPECT_EQ(content_.received_ns, 30);
    EXPECT_EQ(counted(Counter::drop_superseded), 1U);
    EXPECT_EQ(counted(Counter::drop_old_frame), 1U);
    inbox_.take(content_);
    EXPECT_FALSE(content_.has_frame);
}

TEST_F(InboxTest, AHiccupOfPunctualWorkersLosesNoFrame) {
    std::uint32_t number = 0;
    const auto put_next = [&] {
        ++number;
        return put(frame(1, number, number == 122 ? pose_discontinuity : 0U), number);
    };
    for (int i = 0; i < 120; ++i) {
        EXPECT_TRUE(put_next());
        inbox_.take(content_);
    }
    constexpr std::uint32_t most = Inbox::max_late_frames;
    for (std::uint32_t i = 0; i < most; ++i)
        EXPECT_TRUE(put_next());
    for (std::uint32_t i = 1; i <= most; ++i) {
        inbox_.take(content_);
        ASSERT_TRUE(content_.has_frame);
        EXPECT_EQ(content_.frame.frame_number, 120 + i);
        EXPECT_EQ(content_.received_ns, 120 + i);
        EXPECT_EQ(content_.frame.poses.at(0).flags, i == 2 ? pose_discontinuity : 0U);
        EXPECT_EQ(content_.leaves_more, i < most);
    }
    EXPECT_EQ(dropped(), 0U);
}

TEST_F(InboxTest, OfALongerHiccupTheNewestFrameIsShown) {
    for (std::uint32_t number = 1; number <= 120; ++number) {
        put(frame(1, number), number);
        inbox_.take(content_);
    }
    constexpr std::uint32_t last = 121 + Inbox::max_late_frames;
    for (std::uint32_t number = 121; number <= last; ++number)
        put(frame(1, number), number);
    inbox_.take(content_);
    ASSERT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.frame.frame_number, last);
    EXPECT_FALSE(content_.leaves_more);
    EXPECT_EQ(counted(Counter::drop_superseded), std::uint64_t{Inbox::max_late_frames});
}

TEST_F(InboxTest, FramesThatRestEarnNoCredit) {
    for (std::uint32_t number = 2; number <= 120; number += 2) {
        inbox_.rest_until(1'000'000);
        put(frame(1, number - 1), number - 1);  // finds none that waits, but is not due
        inbox_.rest_until(0);
        put(frame(1, number), number);
        inbox_.take(content_);
        ASSERT_EQ(content_.frame.frame_number, number);
    }
    put(frame(1, 121), 121);
    put(frame(1, 122), 122);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.frame_number, 122U);
    EXPECT_EQ(counted(Counter::drop_superseded), 1U);
}

TEST_F(InboxTest, OfFramesThatAreLateAgainAndAgainOneInFortyWaits) {
    int waited = 0;
    for (std::uint32_t number = 1; number <= 8000; ++number) {
        put(frame(1, number), number);
        if (number % 2 != 0) continue;
        inbox_.take(content_);
        waited += content_.leaves_more;
    }
    EXPECT_GT(waited, 90);
    EXPECT_LE(waited, 100) << "of 4000 pairs";
    EXPECT_EQ(counted(Counter::drop_burst), 0U);
}

TEST_F(InboxTest, AFrameIsTakenAndMemoryLeftInItsPlace) {
    PoseFrame taken = frame(1, 1);
    const PlayerPose* poses = taken.poses.data();
    inbox_.put(taken, 10);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.poses.data(), poses);
    PoseFrame next = frame(1, 2);
    inbox_.put(next, 20);
    inbox_.take(content_);
    inbox_.put(taken = frame(1, 3), 30);
    EXPECT_EQ(taken.poses.data(), poses) << "comes back when the frame was processed";
}

TEST_F(InboxTest, FramesOfABurstAreTakenOneByOneWithTheMessagesAroundThem) {
    begin_punctually();
    constexpr std::uint32_t most = Inbox::max_frames;
    for (std::uint32_t number = 1; number <= most; ++number) {
        put_sent_at(number, 33 * ms * number, 400 * ms + number);  // all were held up
        inbox_.put(MatchEvent{1, number});
    }
    inbox_.put(Stage::request("anna"));
    for (std::uint32_t number = 1; number <= most; ++number) {
        EXPECT_EQ(inbox_.frame_waits_since(), 400 * ms + number);
        inbox_.take(content_);
        ASSERT_TRUE(content_.has_frame);
        EXPECT_EQ(content_.frame.frame_number, number);
        EXPECT_EQ(content_.received_ns, 400 * ms + number);
        EXPECT_EQ(content_.messages_before_frame, number == 1 ? 1U : 0U);
        ASSERT_EQ(content_.messages.size(), number == 1 ? 2U : 1U);
        EXPECT_EQ(std::get<MatchEvent>(content_.messages.back()).frame_time, number);
        EXPECT_EQ(content_.leaves_more, number < most);
    }
    EXPECT_EQ(inbox_.frame_waits_since(), std::nullopt);
    EXPECT_EQ(dropped(), 0U);
}

TEST_F(InboxTest, EventsOfABurstStayBounded) {
    begin_punctually();
    for (int i = 0; i < 200; ++i)
        inbox_.put(MatchEvent{});
    put_sent_at(1, 33 * ms, 200 * ms);
    for (int i = 0; i < 56; ++i)
        inbox_.put(MatchEvent{});
    put_sent_at(2, 66 * ms, 200 * ms);
    inbox_.put(MatchEvent{});
    EXPECT_EQ(counted(Counter::drop_events), 1U);
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), 256U);
    for (int i = 0; i < 256; ++i)
        inbox_.put(MatchEvent{});
    EXPECT_EQ(counted(Counter::drop_events), 1U);
}

TEST_F(InboxTest, OfALongBurstTheOldestAreDropped) {
    begin_punctually();
    constexpr std::uint32_t most = Inbox::max_frames;
    for (std::uint32_t number = 1; number <= most + 3; ++number)
        put_sent_at(number, 33 * ms * number, 500 * ms, number == 2 ? pose_discontinuity : 0U);
    for (std::uint32_t number = 4; number <= most + 3; ++number) {
        inbox_.take(content_);
        ASSERT_TRUE(content_.has_frame);
        EXPECT_EQ(content_.frame.frame_number, number);
        EXPECT_EQ(content_.frame.poses.at(0).flags, number == 4 ? pose_discontinuity : 0U);
    }
    EXPECT_EQ(counted(Counter::drop_burst), 3U);
    EXPECT_EQ(dropped(), 3U);
}

TEST_F(InboxTest, CamerasAreNoOlderWhereABurstMeetsBusyWorkers) {
    begin_punctually();
    put_sent_at(1, 33 * ms, 100 * ms, pose_discontinuity);
    put_sent_at(2, 66 * ms, 101 * ms);
    put_sent_at(3, 99 * ms, 102 * ms);
    put_sent_at(4, 132 * ms, 134 * ms);  // nobody has taken those before
    inbox_.take(content_);
    ASSERT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.frame.frame_number, 4U);
    EXPECT_EQ(content_.frame.poses.at(0).flags, pose_discontinuity);
    EXPECT_FALSE(content_.leaves_more);
    EXPECT_EQ(counted(Counter::drop_superseded), 0U) << "a stall is no overload";
    EXPECT_EQ(counted(Counter::drop_burst), 3U);
}

TEST_F(InboxTest, AFrameWaitsBehindABurstThatPunctualWorkersHaveNotGotThrough) {
    put_one_behind_a_burst();
    for (std::uint32_t number = 41; number <= 44; ++number) {
        inbox_.take(content_);
        ASSERT_TRUE(content_.has_frame);
        EXPECT_EQ(content_.frame.frame_number, number);
    }
    EXPECT_EQ(dropped(), 0U);
}

TEST_F(InboxTest, AStallIsNoOverloadWhereAFrameHasWaitedBehindIt) {
    put_one_behind_a_burst();
    put_sent_at(45, 33 * ms * 45, 33 * ms * 45);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.frame_number, 45U);
    EXPECT_EQ(counted(Counter::drop_superseded), 0U);
    EXPECT_EQ(counted(Counter::drop_burst), 4U);
    put_sent_at(46, 33 * ms * 46, 33 * ms * 46);
    put_sent_at(47, 33 * ms * 47, 33 * ms * 47);
    EXPECT_EQ(counted(Counter::drop_superseded), 1U) << "but what follows is";
}

TEST_F(InboxTest, StallsNowAndThenAreNoOverload) {
    begin_punctually();
    std::uint32_t number = 0;
    for (std::int64_t second = 1; second <= 10; ++second) {
        for (std::int64_t i = 1; i <= 20; ++i) {
            const std::int64_t sent = 1000 * ms * (second - 1) + 50 * ms * i;
            const bool stalls = i >= 10 && i < 13;
            put_sent_at(++number, sent, stalls ? 1000 * ms * (second - 1) + 50 * ms * 12 : sent);
            if (!stalls) take_all();
        }
    }
    EXPECT_EQ(counted(Counter::drop_burst), 18U) << "of six, of which the next one came first";
    EXPECT_EQ(dropped(), 18U);
}

TEST_F(InboxTest, BurstsOfWhichWorkersNeverGetToAllAreOverload) {
    begin_punctually();
    for (std::uint32_t batch = 1; batch <= 10; ++batch)
        for (const std::uint32_t number : {2 * batch - 1, 2 * batch})
            put_sent_at(number, 33 * ms * number, 66 * ms * batch);
    EXPECT_EQ(counted(Counter::drop_superseded), 8U) << "after the first batch that comes too late";
    EXPECT_EQ(dropped(), 18U);
}

TEST_F(InboxTest, ANewEpochReplacesABurst) {
    begin_punctually();
    put_sent_at(1, 33 * ms, 200 * ms, pose_discontinuity);
    put_sent_at(2, 66 * ms, 200 * ms);
    put_sent_at(frame(2, 1), 99 * ms, 200 * ms);
    inbox_.take(content_);
    ASSERT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.frame.epoch, 2U);
    EXPECT_EQ(content_.frame.poses.at(0).flags, pose_alive);
    EXPECT_FALSE(content_.leaves_more);
}

TEST_F(InboxTest, AtASlowerPaceTheNewestOfABurstIsShown) {
    begin_punctually();
    put_sent_at(1, 33 * ms, 200 * ms);
    put_sent_at(2, 66 * ms, 200 * ms);
    slow_down_to(2);
    put_sent_at(3, 99 * ms, 200 * ms);  // to be left out: those before go with it
    for (std::uint32_t number = 4; number <= 6; ++number)
        put_sent_at(number, 33 * ms * number, 200 * ms);
    inbox_.take(content_);
    ASSERT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.frame.frame_number, 6U);
    EXPECT_FALSE(content_.leaves_more);
    EXPECT_EQ(counted(Counter::drop_superseded), 0U);
    EXPECT_EQ(counted(Counter::drop_paced), 3U);
    EXPECT_EQ(counted(Counter::drop_burst), 2U);
}

TEST_F(InboxTest, AnEndDropsOnlyTheFramesAfterTheEndBefore) {
    begin_punctually();
    put_sent_at(1, 33 * ms, 200 * ms);
    inbox_.put(MatchEnded{});
    put_sent_at(2, 66 * ms, 200 * ms);
    put_sent_at(3, 99 * ms, 200 * ms);
    inbox_.put(MatchEnded{});
    EXPECT_EQ(inbox_.frame_waits_since(), 200 * ms);
    inbox_.take(content_);
    ASSERT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.frame.frame_number, 1U);
    EXPECT_EQ(content_.messages_before_frame, 0U);
    EXPECT_FALSE(content_.leaves_more);
    EXPECT_EQ(dropped(), 2U);
}

TEST_F(InboxTest, WhatIsForgottenBeforeABurstMovesAllOfIt) {
    begin_punctually();
    inbox_.put(MatchRefused{"first"});
    put_sent_at(1, 33 * ms, 200 * ms);
    inbox_.put(MatchEvent{});
    put_sent_at(2, 66 * ms, 200 * ms);
    inbox_.put(MatchRefused{"second"});
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), 1U);
    EXPECT_EQ(content_.messages_before_frame, 0U);
    inbox_.take(content_);
    ASSERT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.messages_before_frame, 0U);
    ASSERT_EQ(content_.messages.size(), 1U);
    EXPECT_EQ(std::get<MatchRefused>(content_.messages[0]).reason, "second");
}

TEST_F(InboxTest, AFrameKeepsItsPlaceAmongTheMessages) {
    inbox_.put(MatchInfo{});
    put(frame(1, 1), 10);
    inbox_.put(MatchEvent{});
    put(frame(1, 2), 20);
    inbox_.put(MatchEnded{});
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), 3U);
    EXPECT_EQ(content_.messages_before_frame, 2U);
}

TEST_F(InboxTest, ANewEpochWinsWhateverItsNumber) {
    put(frame(1, 900), 1);
    put(frame(2, 1), 2);
    put(frame(1, 901), 3);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.epoch, 2U);
    EXPECT_EQ(counted(Counter::drop_old_epoch), 1U);
}

TEST_F(InboxTest, ARespawnIsNotLostWithItsFrame) {
    put(frame(1, 1, pose_alive | pose_discontinuity), 1);
    put(frame(1, 2), 2);
    put(frame(1, 3), 3);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.poses.at(0).flags, pose_alive | pose_discontinuity);
    put(frame(1, 4), 4);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.poses.at(0).flags, pose_alive);
    put(frame(1, 5, pose_discontinuity), 5);
    put(frame(2, 1), 6);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.poses.at(0).flags, pose_alive) << "another epoch's";
}

TEST_F(InboxTest, AtASlowerPaceSomeFramesAreLeftOutEvenly) {
    slow_down_to(3);
    std::vector<std::uint32_t> taken;
    for (std::uint32_t number = 1; number <= 9; ++number) {
        inbox_.put(Stage::request("a"));
        const bool due = put(frame(1, number, number == 4 ? pose_discontinuity : 0U), 10 * number);
        inbox_.take(content_);
        EXPECT_EQ(content_.has_frame, due);
        EXPECT_EQ(content_.messages.size(), 1U) << "messages do not wait";
        if (!due) continue;
        taken.push_back(content_.frame.frame_number);
        EXPECT_EQ(content_.received_ns, 10 * number);
        EXPECT_EQ(content_.messages_before_frame, 1U);
        EXPECT_EQ(content_.frame.poses.at(0).flags, number == 6 ? pose_discontinuity : 0U);
    }
    EXPECT_EQ(taken, (std::vector<std::uint32_t>{3, 6, 9}));
    EXPECT_EQ(counted(Counter::drop_paced), 6U);
    EXPECT_EQ(counted(Counter::drop_superseded), 0U);
}

TEST_F(InboxTest, AtASlowerPaceOnlyWhatWouldHaveBecomeCamerasIsSuperseded) {
    slow_down_to(3);
    for (std::uint32_t number = 1; number <= 9; ++number)
        EXPECT_EQ(put(frame(1, number), 10 * number), number >= 3);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.frame_number, 9U);
    EXPECT_EQ(counted(Counter::drop_paced), 6U);
    EXPECT_EQ(counted(Counter::drop_superseded), 2U);
}

TEST_F(InboxTest, WhileItRestsAFrameWaitsForALaterOne) {
    EXPECT_TRUE(put(frame(1, 1, pose_discontinuity), 10));
    inbox_.rest_until(40);
    EXPECT_FALSE(inbox_.frame_waits_since());
    inbox_.take(content_);
    EXPECT_FALSE(content_.has_frame);
    EXPECT_FALSE(put(frame(1, 2), 20));
    EXPECT_FALSE(put(frame(1, 3), 30));
    EXPECT_TRUE(put(frame(1, 4), 40));
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.frame_number, 4U);
    EXPECT_EQ(content_.frame.poses.at(0).flags, pose_alive | pose_discontinuity);
    EXPECT_EQ(counted(Counter::drop_paced), 3U);
    EXPECT_EQ(counted(Counter::drop_superseded), 0U);
}

TEST_F(InboxTest, WhatWaitedOfABurstWhileItRestedIsReplaced) {
    for (std::uint32_t number = 1; number <= 3; ++number) {
        PoseFrame poses = frame(1, number);
        EXPECT_TRUE(inbox_.put(poses, 10, Inbox::Arrival::in_burst));
    }
    inbox_.rest_until(40);
    PoseFrame next = frame(1, 4);
    EXPECT_TRUE(inbox_.put(next, 50, Inbox::Arrival::in_burst));
    inbox_.take(content_);
    EXPECT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.frame.frame_number, 4U);
    EXPECT_FALSE(content_.leaves_more);
}

TEST_F(InboxTest, WhileFramesOfABurstArePutAsideMessagesDoNotWait) {
    for (std::uint32_t number = 1; number <= 3; ++number) {
        PoseFrame poses = frame(1, number);
        inbox_.put(poses, 10, Inbox::Arrival::in_burst);
    }
    inbox_.take(content_, false);
    EXPECT_FALSE(content_.has_frame);
    EXPECT_FALSE(content_.leaves_more);
    inbox_.put(ServerLost{});
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), 1U);
    EXPECT_FALSE(content_.has_frame);
}

TEST_F(InboxTest, AFrameThatIsPutAsideDoesNotOutlastItsMatch) {
    EXPECT_TRUE(put(frame(10, 1), 10));
    inbox_.put(MatchEnded{});
    inbox_.take(content_, false);
    EXPECT_TRUE(put(frame(1, 1), 50)) << "of the next match, whatever its epoch";
}

TEST_F(InboxTest, AtASlowerPaceTheLastFrameOfAMatchDoesNotOutlastIt) {
    slow_down_to(3);
    EXPECT_FALSE(put(frame(10, 1), 10));
    inbox_.put(MatchEnded{});
    inbox_.put(Stage::info("m", 5));
    inbox_.take(content_);
    EXPECT_FALSE(content_.has_frame);
    EXPECT_FALSE(put(frame(5, 1), 20));
    EXPECT_FALSE(put(frame(5, 2), 30));
    EXPECT_TRUE(put(frame(5, 3), 40));
    inbox_.take(content_);
    EXPECT_EQ(content_.frame.epoch, 5U);
    EXPECT_EQ(counted(Counter::drop_old_epoch), 0U);
}

TEST_F(InboxTest, BothQueuesAreBounded) {
    for (int i = 0; i < 300; ++i)
        inbox_.put(MatchEvent{});
    for (int i = 0; i < 67; ++i)
        inbox_.put(ViewRequest{});
    inbox_.put(MatchEnded{});
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 256U + 64U + 1U);
    EXPECT_TRUE(std::holds_alternative<MatchEnded>(content_.messages.back())) << "however many came before";
    EXPECT_EQ(counted(Counter::drop_events), 44U);
    EXPECT_EQ(counted(Counter::drop_messages), 3U);
    inbox_.put(MatchEvent{});
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), 1U);
}

TEST_F(InboxTest, ATurnTakesTheRequestsOfSomeObserversAndThoseOfTheRestWait) {
    constexpr std::size_t most = Inbox::max_observers_taken;
    for (std::size_t i = 0; i < 2 * most + 1; ++i)
        inbox_.put(Stage::request(std::to_string(i)));
    inbox_.put(MatchEvent{});
    put(frame(1, 1), 10);
    inbox_.take(content_);
    EXPECT_TRUE(content_.has_frame);
    EXPECT_TRUE(content_.leaves_more);
    ASSERT_EQ(content_.messages.size(), most + 1);
    EXPECT_EQ(content_.messages_before_frame, most + 1);
    EXPECT_EQ(std::get<ObserverRequest>(content_.messages.front()).observer_id, "0");
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), most);
    EXPECT_TRUE(content_.leaves_more);
    inbox_.take(content_);
    EXPECT_FALSE(content_.leaves_more);
    ASSERT_EQ(content_.messages.size(), 1U);
    EXPECT_EQ(std::get<ObserverRequest>(content_.messages[0]).observer_id, std::to_string(2 * most));
    EXPECT_EQ(counted(Counter::drop_messages), 0U);
}

TEST_F(InboxTest, OnlyTheNewestDescriptionOfAnEpochWaits) {
    for (std::uint32_t i = 0; i < 1000; ++i)
        inbox_.put(Stage::info("m", 1, {i}));
    put(frame(1, 1), 10);
    inbox_.put(MatchEvent{1});
    inbox_.put(Stage::info("m", 1, {7}));
    inbox_.put(Stage::info("m", 0));
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 2U);
    EXPECT_EQ(std::get<MatchInfo>(content_.messages[0]).players.at(0).id, 7U);
    EXPECT_EQ(content_.messages_before_frame, 1U);
    EXPECT_EQ(counted(Counter::drop_old_epoch), 1U);
}

TEST_F(InboxTest, ADescriptionOfAnotherMapStaysBehindTheFrameOfTheOneBefore) {
    inbox_.put(info_on("old", 1));
    put(frame(1, 1), 10);
    inbox_.put(info_on("new", 1));
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 2U);
    EXPECT_EQ(content_.messages_before_frame, 1U);
    EXPECT_EQ(std::get<MatchInfo>(content_.messages[0]).map_name, "old");
    EXPECT_EQ(std::get<MatchInfo>(content_.messages[1]).map_name, "new");
}

TEST_F(InboxTest, MapsThatChangeFastDoNotAllWait) {
    for (int i = 0; i < 1000; ++i)
        inbox_.put(info_on(std::to_string(i), 1));
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 8U);
    EXPECT_EQ(std::get<MatchInfo>(content_.messages.back()).map_name, "999");
}

TEST_F(InboxTest, ADescriptionAfterAnEndIsOfAnotherMatch) {
    inbox_.put(Stage::info("m", 5));
    inbox_.put(MatchEnded{});
    inbox_.put(Stage::info("m", 1));
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 3U);
    EXPECT_EQ(std::get<MatchInfo>(content_.messages.back()).epoch, 1U);
}

TEST_F(InboxTest, OfMatchesThatBeginAndEndMeanwhileNothingWaits) {
    inbox_.put(MatchEvent{});
    for (std::uint32_t i = 1; i <= 1000; ++i) {
        inbox_.put(MatchEnded{});
        inbox_.put(Stage::info("m", 1));
        put(frame(1, i), i);
        inbox_.put(MatchEvent{});
    }
    inbox_.put(MatchEnded{});
    inbox_.put(MapsChanged{});
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 3U);
    EXPECT_TRUE(std::holds_alternative<MatchEvent>(content_.messages[0]));
    EXPECT_TRUE(std::holds_alternative<MatchEnded>(content_.messages[1]));
    EXPECT_TRUE(std::holds_alternative<MapsChanged>(content_.messages[2]));
    EXPECT_FALSE(content_.has_frame);
    EXPECT_EQ(counted(Counter::drop_events), 1000U);
    EXPECT_EQ(counted(Counter::drop_superseded), 1000U);
}

TEST_F(InboxTest, TheFrameBeforeAnEndIsKept) {
    put(frame(1, 1), 10);
    inbox_.put(MatchEnded{});
    inbox_.put(Stage::info("m", 1));
    inbox_.put(MatchEnded{});
    inbox_.take(content_);
    EXPECT_TRUE(content_.has_frame);
    EXPECT_EQ(content_.messages_before_frame, 0U);
    EXPECT_EQ(content_.messages.size(), 1U);
}

TEST_F(InboxTest, AGameServerThatIsLostAndBackAgainAndAgainIsSoOnce) {
    for (std::uint32_t i = 0; i < 1000; ++i) {
        inbox_.put(ServerLost{});
        inbox_.put(Stage::info("m", 1, {i}));
        put(frame(1, i), i);
    }
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 2U);
    EXPECT_TRUE(std::holds_alternative<ServerLost>(content_.messages[0]));
    EXPECT_EQ(std::get<MatchInfo>(content_.messages[1]).players.at(0).id, 999U);
    EXPECT_EQ(content_.messages_before_frame, 2U);
}

TEST_F(InboxTest, OnlyTheNewestRefusalWaits) {
    for (int i = 0; i < 1000; ++i)
        inbox_.put(MatchRefused{std::to_string(i)});
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 1U);
    EXPECT_EQ(std::get<MatchRefused>(content_.messages[0]).reason, "999");
}

TEST_F(InboxTest, EpochsThatRiseFastDoNotAllWait) {
    for (std::uint64_t epoch = 1; epoch <= 1000; ++epoch)
        inbox_.put(Stage::info("m", epoch));
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 8U);
    EXPECT_EQ(std::get<MatchInfo>(content_.messages[6]).epoch, 7U);
    EXPECT_EQ(std::get<MatchInfo>(content_.messages[7]).epoch, 1000U);
}

TEST_F(InboxTest, OneReminderIsEnough) {
    for (int i = 0; i < 3; ++i) {
        inbox_.put(DelayChanged{});
        inbox_.put(MapsChanged{});
    }
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), 2U);
}

}  // namespace
}  // namespace camdir::director
