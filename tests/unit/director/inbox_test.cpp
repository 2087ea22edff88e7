#include "director/inbox.hpp"

#include <gtest/gtest.h>

#include "director/roster.hpp"
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
        sent.source_time = sent_ns;
        put(std::move(sent), received_ns);
    }

    MatchCounters counters_;
    Pace pace_;
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
    EXPECT_EQ(content_.frame_count, 0U);
    inbox_.take(content_);
    EXPECT_TRUE(content_.messages.empty());
}

TEST_F(InboxTest, TheNewestFrameWins) {
    put(frame(1, 1), 10);
    put(frame(1, 3), 30);
    put(frame(1, 2), 20);
    inbox_.take(content_);
    ASSERT_EQ(content_.frame_count, 1U);
    EXPECT_EQ(content_.frames()[0].poses.frame_number, 3U);
    EXPECT_EQ(content_.frames()[0].received_ns, 30);
    EXPECT_EQ(counted(Counter::drop_superseded), 1U);
    EXPECT_EQ(counted(Counter::drop_old_frame), 1U);
    inbox_.take(content_);
    EXPECT_EQ(content_.frame_count, 0U);
}

TEST_F(InboxTest, AFrameIsTakenAndMemoryLeftInItsPlace) {
    PoseFrame taken = frame(1, 1);
    const PlayerPose* poses = taken.poses.data();
    inbox_.put(taken, 10);
    inbox_.take(content_);
    EXPECT_EQ(content_.frames()[0].poses.poses.data(), poses);
    PoseFrame next = frame(1, 2);
    inbox_.put(next, 20);
    inbox_.take(content_);
    inbox_.put(taken = frame(1, 3), 30);
    EXPECT_EQ(taken.poses.data(), poses) << "comes back when the frame was processed";
}

TEST_F(InboxTest, FramesThatCameTogetherAllBecomeCameras) {
    constexpr std::uint32_t most = Inbox::max_frames;
    for (std::uint32_t number = 1; number <= most; ++number) {
        put_sent_at(number, 33 * ms * number, 200 * ms + number);  // all were held up
        inbox_.put(MatchEvent{1, number});
    }
    EXPECT_EQ(inbox_.frame_waits_since(), 200 * ms + 1);
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), most);
    ASSERT_EQ(content_.frame_count, most);
    for (std::uint32_t i = 0; i < most; ++i) {
        EXPECT_EQ(content_.frames()[i].poses.frame_number, i + 1);
        EXPECT_EQ(content_.frames()[i].received_ns, 200 * ms + i + 1);
        EXPECT_EQ(content_.frames()[i].messages_before, i) << "with the events between them";
    }
    EXPECT_EQ(dropped(), 0U);
    EXPECT_EQ(inbox_.frame_waits_since(), std::nullopt);
}

TEST_F(InboxTest, OfMoreFramesThatCameTogetherTheOldestAreDropped) {
    constexpr std::uint32_t most = Inbox::max_frames;
    for (std::uint32_t number = 1; number <= most + 3; ++number)
        put_sent_at(number, 33 * ms * number, 300 * ms, number == 2 ? pose_discontinuity : 0U);
    inbox_.take(content_);
    ASSERT_EQ(content_.frame_count, most);
    for (std::uint32_t i = 0; i < most; ++i) {
        EXPECT_EQ(content_.frames()[i].poses.frame_number, i + 4);
        EXPECT_EQ(content_.frames()[i].poses.poses.at(0).flags, i == 0 ? pose_discontinuity : 0U);
    }
    EXPECT_EQ(counted(Counter::drop_burst), 3U);
    EXPECT_EQ(dropped(), 3U);
}

TEST_F(InboxTest, CamerasAreNoOlderWhereFramesCameTogetherAndWorkersAreBusy) {
    put_sent_at(1, 0, 100 * ms, pose_discontinuity);
    put_sent_at(2, 33 * ms, 101 * ms);
    put_sent_at(3, 66 * ms, 134 * ms);  // nobody has taken those before
    EXPECT_EQ(counted(Counter::drop_superseded), 2U);
    put_sent_at(4, 66 * ms, 134 * ms);  // by a sender whose clock stands
    EXPECT_EQ(counted(Counter::drop_superseded), 3U);
    inbox_.take(content_);
    ASSERT_EQ(content_.frame_count, 1U);
    EXPECT_EQ(content_.frames()[0].poses.frame_number, 4U);
    EXPECT_EQ(content_.frames()[0].poses.poses.at(0).flags, pose_discontinuity);
    EXPECT_EQ(dropped(), 3U);
}

TEST_F(InboxTest, AtASlowerPaceOfFramesThatCameTogetherTheNewestIsShown) {
    for (int interval = 0; interval < 3; ++interval)
        pace_.observe({.taken = 200, .superseded = 70, .busy = 1.0});
    ASSERT_EQ(pace_.frames_per_camera(), 2U);
    for (std::uint32_t number = 1; number <= 4; ++number)
        put_sent_at(number, 33 * ms * number, 200 * ms);
    inbox_.take(content_);
    ASSERT_EQ(content_.frame_count, 1U);
    EXPECT_EQ(content_.frames()[0].poses.frame_number, 4U);
    EXPECT_EQ(counted(Counter::drop_paced), 2U);
    EXPECT_EQ(counted(Counter::drop_burst), 1U);
}

TEST_F(InboxTest, AnEndDropsOnlyTheFramesAfterTheEndBefore) {
    put_sent_at(1, 33 * ms, 100 * ms);
    inbox_.put(MatchEnded{});
    put_sent_at(2, 66 * ms, 100 * ms);
    put_sent_at(3, 99 * ms, 100 * ms);
    inbox_.put(MatchEnded{});
    EXPECT_EQ(inbox_.frame_waits_since(), 100 * ms);
    inbox_.take(content_);
    ASSERT_EQ(content_.frame_count, 1U);
    EXPECT_EQ(content_.frames()[0].poses.frame_number, 1U);
    EXPECT_EQ(content_.frames()[0].messages_before, 0U);
    EXPECT_EQ(counted(Counter::drop_superseded), 2U);
}

TEST_F(InboxTest, WhatIsForgottenBeforeFramesMovesAllOfThem) {
    inbox_.put(MatchRefused{"first"});
    inbox_.put(Stage::request("anna"));
    put_sent_at(1, 33 * ms, 100 * ms);
    inbox_.put(MatchEvent{});
    put_sent_at(2, 66 * ms, 100 * ms);
    inbox_.put(MatchRefused{"second"});
    inbox_.take(content_);
    ASSERT_EQ(content_.frame_count, 2U);
    EXPECT_EQ(content_.messages.size(), 3U);
    EXPECT_EQ(content_.frames()[0].messages_before, 1U);
    EXPECT_EQ(content_.frames()[1].messages_before, 2U);
}

TEST_F(InboxTest, AFrameKeepsItsPlaceAmongTheMessages) {
    inbox_.put(MatchInfo{});
    put(frame(1, 1), 10);
    inbox_.put(MatchEvent{});
    put(frame(1, 2), 20);
    inbox_.put(MatchEnded{});
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), 3U);
    EXPECT_EQ(content_.frames()[0].messages_before, 2U);
}

TEST_F(InboxTest, ANewEpochWinsWhateverItsNumber) {
    put(frame(1, 900), 1);
    put(frame(2, 1), 2);
    put(frame(1, 901), 3);
    inbox_.take(content_);
    EXPECT_EQ(content_.frames()[0].poses.epoch, 2U);
    EXPECT_EQ(counted(Counter::drop_old_epoch), 1U);
}

TEST_F(InboxTest, ARespawnIsNotLostWithItsFrame) {
    put(frame(1, 1, pose_alive | pose_discontinuity), 1);
    put(frame(1, 2), 2);
    put(frame(1, 3), 3);
    inbox_.take(content_);
    EXPECT_EQ(content_.frames()[0].poses.poses.at(0).flags, pose_alive | pose_discontinuity);
    put(frame(1, 4), 4);
    inbox_.take(content_);
    EXPECT_EQ(content_.frames()[0].poses.poses.at(0).flags, pose_alive);
    put(frame(1, 5, pose_discontinuity), 5);
    put(frame(2, 1), 6);
    inbox_.take(content_);
    EXPECT_EQ(content_.frames()[0].poses.poses.at(0).flags, pose_alive) << "another epoch's";
}

TEST_F(InboxTest, AtASlowerPaceSomeFramesAreLeftOutEvenly) {
    for (int interval = 0; interval < 3; ++interval)
        pace_.observe({.taken = 200, .superseded = 200, .busy = 1.0});
    ASSERT_EQ(pace_.frames_per_camera(), 3U);
    std::vector<std::uint32_t> taken;
    for (std::uint32_t number = 1; number <= 9; ++number) {
        inbox_.put(Stage::request("a"));
        const bool due = put(frame(1, number, number == 4 ? pose_discontinuity : 0U), 10 * number);
        inbox_.take(content_);
        EXPECT_EQ(content_.frame_count, due ? 1U : 0U);
        EXPECT_EQ(content_.messages.size(), 1U) << "messages do not wait";
        if (!due) continue;
        taken.push_back(content_.frames()[0].poses.frame_number);
        EXPECT_EQ(content_.frames()[0].received_ns, 10 * number);
        EXPECT_EQ(content_.frames()[0].messages_before, 1U);
        EXPECT_EQ(content_.frames()[0].poses.poses.at(0).flags, number == 6 ? pose_discontinuity : 0U);
    }
    EXPECT_EQ(taken, (std::vector<std::uint32_t>{3, 6, 9}));
    EXPECT_EQ(counted(Counter::drop_paced), 6U);
    EXPECT_EQ(counted(Counter::drop_superseded), 0U);
}

TEST_F(InboxTest, AtASlowerPaceOnlyWhatWouldHaveBecomeCamerasIsSuperseded) {
    for (int interval = 0; interval < 3; ++interval)
        pace_.observe({.taken = 200, .superseded = 200, .busy = 1.0});
    ASSERT_EQ(pace_.frames_per_camera(), 3U);
    for (std::uint32_t number = 1; number <= 9; ++number)
        EXPECT_EQ(put(frame(1, number), 10 * number), number >= 3);
    inbox_.take(content_);
    EXPECT_EQ(content_.frames()[0].poses.frame_number, 9U);
    EXPECT_EQ(counted(Counter::drop_paced), 6U);
    EXPECT_EQ(counted(Counter::drop_superseded), 2U);
}

TEST_F(InboxTest, AtASlowerPaceTheLastFrameOfAMatchDoesNotOutlastIt) {
    for (int interval = 0; interval < 3; ++interval)
        pace_.observe({.taken = 200, .superseded = 200, .busy = 1.0});
    ASSERT_EQ(pace_.frames_per_camera(), 3U);
    EXPECT_FALSE(put(frame(10, 1), 10));
    inbox_.put(MatchEnded{});
    inbox_.put(Stage::info("m", 5));
    inbox_.take(content_);
    EXPECT_EQ(content_.frame_count, 0U);
    EXPECT_FALSE(put(frame(5, 1), 20));
    EXPECT_FALSE(put(frame(5, 2), 30));
    EXPECT_TRUE(put(frame(5, 3), 40));
    inbox_.take(content_);
    EXPECT_EQ(content_.frames()[0].poses.epoch, 5U);
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
    ASSERT_EQ(content_.frame_count, 1U);
    EXPECT_TRUE(content_.leaves_requests);
    ASSERT_EQ(content_.messages.size(), most + 1);
    EXPECT_EQ(content_.frames()[0].messages_before, most + 1);
    EXPECT_EQ(std::get<ObserverRequest>(content_.messages.front()).observer_id, "0");
    inbox_.take(content_);
    EXPECT_EQ(content_.messages.size(), most);
    EXPECT_TRUE(content_.leaves_requests);
    inbox_.take(content_);
    EXPECT_FALSE(content_.leaves_requests);
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
    EXPECT_EQ(content_.frames()[0].messages_before, 1U);
    EXPECT_EQ(counted(Counter::drop_old_epoch), 1U);
}

TEST_F(InboxTest, ADescriptionOfAnotherMapStaysBehindTheFrameOfTheOneBefore) {
    inbox_.put(info_on("old", 1));
    put(frame(1, 1), 10);
    inbox_.put(info_on("new", 1));
    inbox_.take(content_);
    ASSERT_EQ(content_.messages.size(), 2U);
    EXPECT_EQ(content_.frames()[0].messages_before, 1U);
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
    EXPECT_EQ(content_.frame_count, 0U);
    EXPECT_EQ(counted(Counter::drop_events), 1000U);
    EXPECT_EQ(counted(Counter::drop_superseded), 1000U);
}

TEST_F(InboxTest, TheFrameBeforeAnEndIsKept) {
    put(frame(1, 1), 10);
    inbox_.put(MatchEnded{});
    inbox_.put(Stage::info("m", 1));
    inbox_.put(MatchEnded{});
    inbox_.take(content_);
    ASSERT_EQ(content_.frame_count, 1U);
    EXPECT_EQ(content_.frames()[0].messages_before, 0U);
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
    EXPECT_EQ(content_.frames()[0].messages_before, 2U);
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
