#include "gateway_test.hpp"

#include <gmock/gmock.h>

#include <limits>
#include <optional>
#include <thread>

#include "dds/encode.hpp"

namespace camdir::dds {
namespace {

director::MatchInfo info_of(const std::string& match_id, std::uint64_t epoch) {
    director::MatchInfo info;
    info.match_id = match_id;
    info.epoch = epoch;
    info.map_name = "hall";
    return info;
}

director::CameraFrame one_camera(std::uint32_t frame_number) {
    director::CameraFrame frame;
    frame.epoch = 1;
    frame.frame_number = frame_number;
    frame.cameras.emplace_back();
    frame.cameras.back().camera_id = 9;
    frame.cameras.back().position = {1.0F, 2.0F, 3.0F};
    return frame;
}

director::ObserverStatus status_of(const std::string& observer_id, const std::string& reason) {
    director::ObserverStatus status;
    status.match_id = "cup";
    status.observer_id = observer_id;
    status.state = director::RequestState::accepted;
    status.reason = reason;
    return status;
}

TEST_F(GatewayTest, HandsOnTheSamplesOfAMatch) {
    RawPeer& raw = game("cup");
    EXPECT_TRUE(recorder_.has("info cup 1"));

    RawPoseFrame frame("cup", 1, 5, 8);
    EXPECT_TRUE(arrives(raw, frame, "pose cup 5"));
    camera_director_MatchEvent event{};
    std::snprintf(event.match_id, sizeof event.match_id, "cup");
    event.kind = 7;
    std::snprintf(event.detail, sizeof event.detail, "item_armor_body");
    raw.write(event);
    EXPECT_TRUE(eventually([&] { return recorder_.has("event cup 7 item_armor_body"); }));
    raw.write(test::raw_request("cup", "anna", 3));
    EXPECT_TRUE(eventually([&] { return recorder_.has("request anna 3"); }));
    raw.write(test::raw_request("cup", "anna", 4));
    EXPECT_TRUE(eventually([&] { return recorder_.has("request anna 4"); }));
    raw.dispose(test::raw_request("cup", "anna", 4));
    EXPECT_TRUE(eventually([&] { return recorder_.has("gone anna"); }));

    raw.write(test::raw_match_info("cup", 2));
    EXPECT_TRUE(eventually([&] { return recorder_.has("info cup 2"); }));
    EXPECT_EQ(gateway_->counters().matches, 1U);
}

TEST_F(GatewayTest, PosesThatArriveTogetherAreHandedOnInTheirOrder) {
    struct Game {
        std::string id;
        RawPeer& raw;
    };
    const Game games[] = {{"a", game("a")}, {"b", game("b")}};
    for (const auto& [id, raw] : games) {
        RawPoseFrame first(id, 1, 1, 8);
        ASSERT_TRUE(arrives(raw, first, "pose " + id + " 1"));
    }
    recorder_.hangs = true;
    games[0].raw.write(test::raw_match_info("a", 2));
    ASSERT_TRUE(eventually([&] { return recorder_.has("info a 2"); }));
    for (std::uint32_t number = 2; number <= 7; ++number)
        for (const auto& [id, raw] : games)
            raw.write(RawPoseFrame(id, 1, number, 8).sample());
    recorder_.hangs = false;
    ASSERT_TRUE(eventually([&] { return recorder_.has("pose a 7") && recorder_.has("pose b 7"); }));
    const auto lines = recorder_.lines();
    for (const auto& [id, raw] : games) {
        const auto place = [&, &match_id = id](std::uint32_t number) {
            return std::ranges::find(lines, "pose " + match_id + " " + std::to_string(number));
        };
        for (std::uint32_t number = 2; number <= 7; ++number) {
            EXPECT_EQ(recorder_.count("pose " + id + " " + std::to_string(number)), 1) << "of " << id;
            EXPECT_LT(place(number - 1), place(number)) << "of " << id;
        }
    }
}

TEST_F(GatewayTest, WritesCamerasAndStatuses) {
    RawPeer& raw = led_game("cup");
    gateway_->publish("cup", one_camera(0));
    std::vector<RawPeer::CameraFrame> frames;
    ASSERT_TRUE(eventually([&] { return !(frames = raw.take_cameras()).empty(); }));
    EXPECT_EQ(frames[0].match_id, "cup");
    EXPECT_EQ(frames[0].director_id, 77U);
    EXPECT_GT(frames[0].write_time, 0);
    ASSERT_EQ(frames[0].cameras.size(), 1U);
    EXPECT_EQ(frames[0].cameras[0].id, 9U);
    EXPECT_EQ(frames[0].cameras[0].position[2], 3.0F);

    director::ObserverStatus status = status_of("anna", "the map is being baked");
    status.state = director::RequestState::waiting_for_map;
    gateway_->publish(status);
    ASSERT_TRUE(eventually([&] { return raw.statuses().count("anna") == 1; }));
    EXPECT_EQ(raw.statuses().at("anna").state, 2U);
    EXPECT_STREQ(raw.statuses().at("anna").reason, "the map is being baked");
    gateway_->withdraw("cup", "anna");
    EXPECT_TRUE(eventually([&] { return raw.statuses().empty(); }));

    gateway_->publish("nobody's match", one_camera(0));
    EXPECT_EQ(gateway_->counters().camera_frames_written, 1U);
    EXPECT_EQ(gateway_->counters().write_failures, 0U);
}

TEST_F(GatewayTest, WhatIsShownIsWrittenForLateObserversAndAgainUntilItsEnd) {
    RawPeer& raw = game("cup");
    const auto sees = [](RawPeer& peer, const std::optional<std::uint64_t>& epoch, int times) {
        return eventually([&] {
            for (const auto& shown : peer.take_shown_epochs())
                times -= shown == epoch ? 1 : 0;
            return times <= 0;
        });
    };
    gateway_->publish(info_of("cup", 1));
    EXPECT_TRUE(sees(raw, 1, 3));
    gateway_->publish(info_of("cup", 2));
    EXPECT_TRUE(sees(raw, 2, 3));
    RawPeer& late = peer("cup");
    EXPECT_TRUE(sees(late, 2, 1));
    gateway_->end("cup");
    EXPECT_TRUE(sees(raw, std::nullopt, 1));
    EXPECT_TRUE(sees(late, std::nullopt, 1));
    EXPECT_EQ(gateway_->counters().shown_matches_written, 3U) << "without those written again";
}

// Another director that leads "cup" as long as this lives, and is then silent for longer than it said.
class Leader {
  public:
    Leader(RawPeer& peer, std::uint32_t term) : peer_(peer), term_(term) { lead(max_lease); }
    Leader(const Leader&) = delete;
    Leader& operator=(const Leader&) = delete;
    ~Leader() { lead(std::chrono::milliseconds(1)); }

  private:
    void lead(std::chrono::milliseconds lease) {
        peer_.write(encode(
            "cup", {.director_id = 5, .term = term_, .lease = lease, .leads = true, .has_cameras = true}));
    }

    RawPeer& peer_;
    const std::uint32_t term_;
};

class StandbyTest : public GatewayTest {
  protected:
    StandbyTest() { config_.lease_ms = max_lease.count(); }  // what it keeps does not grow too old
    std::size_t frames(RawPeer& raw) { return frames_ += raw.take_cameras().size(); }

    std::size_t frames_ = 0;
};

TEST_F(StandbyTest, WritesWhatItKeptWhenTheLeaderFailsAndStandsByUnderALaterOne) {
    RawPeer& other = peer("cup");
    auto leader = std::make_unique<Leader>(other, 3);
    RawPeer& raw = game("cup");
    gateway_->publish(info_of("cup", 1));
    gateway_->publish(status_of("anna", ""));
    for (std::uint32_t i = 0; i < 5; ++i)
        gateway_->publish("cup", one_camera(i));
    RawPeer& later = peer("cup");
    ASSERT_TRUE(eventually([&] { return later.directors() == 1; }));
    EXPECT_TRUE(raw.statuses().empty() && frames(raw) == 0 && raw.take_shown_epochs().empty());

    leader.reset();
    EXPECT_TRUE(eventually([&] { return raw.statuses().size() == 1 && frames(raw) == 5; }));
    EXPECT_FALSE(raw.take_shown_epochs().empty());

    leader = std::make_unique<Leader>(other, 3);  // it was only stopped
    gateway_->publish("cup", one_camera(5));
    EXPECT_TRUE(eventually([&] { return frames(raw) == 6; }));
    leader.reset();
    leader = std::make_unique<Leader>(other, 9);
    EXPECT_TRUE(eventually([&] { return raw.statuses().empty(); })) << "they are the leader's now";
    leader.reset();
}

TEST_F(StandbyTest, LooksForALeaderHoweverLongTheDirectorTakesToBeginTheMatch) {
    RawPeer& other = peer("cup");
    const Leader leader(other, 3);
    recorder_.hangs = true;
    RawPeer& raw = peer("cup");
    raw.write(test::raw_match_info("cup", 1));
    ASSERT_TRUE(eventually([&] { return recorder_.has("info cup 1"); }));
    gateway_->publish("cup", one_camera(0));
    ASSERT_TRUE(eventually([&] { return other.signs_are_known(); }));
    std::this_thread::sleep_for(Succession::settling);
    recorder_.hangs = false;
    EXPECT_TRUE(eventually([&] { return gateway_->counters().of(Topic::director_sign).accepted > 0; }));
    EXPECT_EQ(frames(raw), 0U);
}

// A standby that sees frame 40, of pose 0, of a leader, computes `count` cameras more and takes over.
class TakeOverTest : public StandbyTest {
  protected:
    std::vector<std::uint32_t> numbers_after(std::uint32_t count) {
        RawPeer& other = peer("cup");
        auto leader = std::make_unique<Leader>(other, 3);
        RawPeer& raw = game("cup");
        CameraFrameEncoder encoder("cup", 5);
        EXPECT_TRUE(eventually([&] {  // until the gateway's reader is found
            other.write(encoder.encode(camera_of_pose(0), 0, 40));
            return recorder_.has("follow cup 0");
        }));
        EXPECT_FALSE(gateway_->leads("cup"));
        for (std::uint32_t i = 0; i <= count; ++i)  // that of pose 0 was shown
            gateway_->publish("cup", camera_of_pose(i));
        leader.reset();
        std::vector<std::uint32_t> numbers;
        EXPECT_TRUE(eventually([&] {
            bool is_last = false;
            for (const auto& frame : raw.take_cameras()) {
                if (frame.director_id != 77) continue;
                numbers.push_back(frame.frame_number);
                is_last = frame.pose_number == count;
            }
            return is_last;
        }));
        EXPECT_TRUE(gateway_->leads("cup"));
        EXPECT_FALSE(gateway_->leads("another match"));
        return numbers;
    }

  private:
    static director::CameraFrame camera_of_pose(std::uint32_t number) {
        director::CameraFrame frame = one_camera(number);
        frame.pose_number = number;
        return frame;
    }
};

TEST_F(TakeOverTest, FramesCountOnFromTheLeaders) {
    EXPECT_EQ(numbers_after(3), (std::vector<std::uint32_t>{41, 42, 43}));
}

TEST_F(TakeOverTest, AGapTellsOfFramesThatNobodyWrote) {
    const auto numbers = numbers_after(40);
    ASSERT_EQ(numbers.size(), 32U);
    EXPECT_EQ(numbers.front(), 42U);
    EXPECT_EQ(numbers.back(), 73U);
}

TEST_F(StandbyTest, TellsWhetherAStatusIsPublished) {
    RawPeer& other = peer("cup");
    const Leader leader(other, 3);
    game("cup");
    EXPECT_TRUE(gateway_->publish(status_of("anna", ""))) << "it is kept";
    director::ObserverStatus lost = status_of("anna", "");
    lost.match_id = "nobody's match";
    EXPECT_FALSE(gateway_->publish(lost));

    std::vector<std::string> neighbours;  // of the same bucket
    for (int i = 0; neighbours.size() < StatusBuckets::max_statuses; ++i)
        if (StatusBuckets::number_of(std::to_string(i)) == StatusBuckets::number_of("anna"))
            neighbours.push_back(std::to_string(i));
    const std::string last = neighbours.back();
    neighbours.pop_back();
    for (const std::string& neighbour : neighbours)
        ASSERT_TRUE(gateway_->publish(status_of(neighbour, "")));
    EXPECT_FALSE(gateway_->publish(status_of(last, ""))) << "its bucket is full";
    gateway_->withdraw("cup", "anna");
    EXPECT_TRUE(gateway_->publish(status_of(last, "")));
}

TEST_F(StandbyTest, OwnsWhatItWritesBeforeALeaderThatWasOnlyStopped) {
    RawPeer& other = peer("cup");
    auto leader = std::make_unique<Leader>(other, 3);
    RawPeer& raw = game("cup");
    gateway_->publish("cup", one_camera(0));
    leader.reset();
    ASSERT_TRUE(eventually([&] { return frames(raw) == 1; }));
    EXPECT_GE(raw.camera_strength(), 4 * 65536);
}

TEST_F(GatewayTest, WhatTheDirectorShowsAtOnceIsWritten) {
    recorder_.shows_at_once = gateway_.get();
    RawPeer& raw = game("cup", 5);
    EXPECT_TRUE(eventually([&] {
        const auto shown = raw.take_shown_epochs();
        return !shown.empty() && shown[0] == 5;
    }));
}

TEST_F(GatewayTest, AnIdleReaderLosesNothingWithin32Frames) {
    RawPeer& raw = led_game("cup");
    for (std::uint32_t i = 0; i < 32; ++i)
        gateway_->publish("cup", one_camera(i));
    std::vector<RawPeer::CameraFrame> frames;
    ASSERT_TRUE(eventually([&] {
        for (auto& frame : raw.take_cameras())
            frames.push_back(frame);
        return frames.size() >= 32;
    }));
    for (std::uint32_t i = 0; i < 32; ++i)
        EXPECT_EQ(frames[i].frame_number, i);
}

TEST_F(GatewayTest, LateObserversSeeStatusesButNoOldCameras) {
    RawPeer& raw = led_game("cup");
    gateway_->publish("cup", one_camera(0));
    ASSERT_TRUE(eventually([&] { return !raw.take_cameras().empty(); }));
    for (int i = 0; i < 256; ++i) {
        gateway_->publish(status_of(std::to_string(i), ""));
    }
    RawPeer& late = peer("cup");
    EXPECT_TRUE(eventually([&] { return late.statuses().size() == 256; }));
    EXPECT_TRUE(late.take_cameras().empty());
}

TEST_F(GatewayTest, RequestsFromBeforeTheMatchAreReceived) {
    const auto count = static_cast<std::uint32_t>(limits_.observers / 2);  // of one participant
    RawPeer& observer = peer("cup");
    for (std::uint32_t i = 0; i < count; ++i) {
        observer.write(test::raw_request("cup", "early " + std::to_string(i), i));
    }
    game("cup");
    EXPECT_TRUE(eventually([&] {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!recorder_.has("request early " + std::to_string(i) + " " + std::to_string(i))) return false;
        }
        return true;
    }));
}

TEST_F(GatewayTest, CountsHowLongPosesWereOnTheirWay) {
    using namespace std::chrono_literals;
    RawPeer& raw = game("cup");
    RawPoseFrame frame("cup", 1, 100, 4);
    // Of all so far, when those that were sampled then have made it at least so long.
    const auto sent = [&](std::int64_t source_time, double least_s) {
        camera_director_PoseFrame sample = frame.sample();
        sample.source_time = source_time;
        director::Durations sum;
        EXPECT_TRUE(eventually([&] {
            raw.write(sample);
            sum = {};
            gateway_->counters().reception.add_to(sum);
            return sum.sum_s >= least_s && sum.buckets != director::Durations{}.buckets;
        }));
        return sum;
    };
    const auto of_the_future = sent(std::numeric_limits<std::int64_t>::max(), 0.0);
    EXPECT_EQ(of_the_future.sum_s, 0.0);
    EXPECT_GT(of_the_future.buckets.front(), 0U);
    const std::int64_t now = std::chrono::system_clock::now().time_since_epoch() / 1ns;
    EXPECT_GT(sent(now - 300ms / 1ns, 0.3).buckets.back(), 0U) << "longer than the longest bound";
    EXPECT_LT(sent(std::numeric_limits<std::int64_t>::min(), 10.0).sum_s, 1000.0) << "10 s each";
}

TEST_F(GatewayTest, MalformedSamplesAreCountedByReasonAndNotHandedOn) {
    RawPeer& raw = game("cup");
    const auto refused = [&](RawPoseFrame& frame, ValidationError error) {
        return eventually([&] {
            raw.write(frame.sample());
            return dropped(Topic::pose_frame, error) > 0;
        });
    };
    RawPoseFrame lengths("cup", 1, 100, 4);
    lengths.eye.pop_back();
    EXPECT_TRUE(refused(lengths, ValidationError::array_length));
    RawPoseFrame crowd("cup", 1, 101, 300);
    EXPECT_TRUE(refused(crowd, ValidationError::too_many));
    RawPoseFrame infinite("cup", 1, 102, 4);
    infinite.velocity[3] = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(refused(infinite, ValidationError::not_finite));
    RawPoseFrame twisted("cup", 1, 103, 4);
    twisted.orientation[1] = 0.5F;
    EXPECT_TRUE(refused(twisted, ValidationError::not_unit));
    RawPoseFrame foreign("another match", 1, 104, 4);
    EXPECT_TRUE(refused(foreign, ValidationError::wrong_partition));

    RawPoseFrame good("cup", 1, 105, 4);
    EXPECT_TRUE(arrives(raw, good, "pose cup 105"));
    for (std::uint32_t frame = 100; frame < 105; ++frame) {
        EXPECT_FALSE(recorder_.has("pose cup " + std::to_string(frame)));
    }
}

TEST_F(GatewayTest, AMatchInfoIsAcceptedOnlyInItsOwnPartition) {
    RawPeer& impostor = peer("evil");
    impostor.write(test::raw_match_info("cup", 99));
    EXPECT_TRUE(eventually([&] { return dropped(Topic::match_info, ValidationError::wrong_partition) > 0; }));
    RawPeer& pattern = peer("tab\t");
    pattern.write(test::raw_match_info("tab\t", 1));
    EXPECT_TRUE(eventually([&] { return dropped(Topic::match_info, ValidationError::bad_match_id) > 0; }));
    EXPECT_TRUE(recorder_.lines().empty());
}

TEST_F(GatewayTest, AnotherProcessCannotEndAMatch) {
    (void)game("cup");
    RawPeer& stranger = peer("evil");
    stranger.dispose(test::raw_match_info("cup", 1));
    stranger.write(test::raw_match_info("dup", 1));  // arrives after the disposal
    ASSERT_TRUE(eventually([&] { return dropped(Topic::match_info, ValidationError::wrong_partition) > 0; }));
    EXPECT_FALSE(recorder_.has("over cup"));
}

TEST_F(GatewayTest, DisposingEndsAMatchAndForgettingItRemovesItsEndpoints) {
    RawPeer& raw = game("cup");
    raw.dispose(test::raw_match_info("cup", 1));
    ASSERT_TRUE(eventually([&] { return recorder_.has("over cup"); }));
    EXPECT_EQ(raw.directors(), 1U) << "for observers that wait";
    gateway_->forget("cup");
    EXPECT_TRUE(eventually([&] { return raw.directors() == 0 && gateway_->counters().matches == 0; }));

    raw.write(test::raw_match_info("cup", 2));
    EXPECT_TRUE(eventually([&] { return recorder_.has("info cup 2") && raw.directors() == 1; }));
}

TEST_F(GatewayTest, AForgottenMatchWithAPausedServerReturnsWithItsPoses) {
    RawPeer& raw = game("cup");
    ASSERT_TRUE(last_arrives(raw, "cup", 0)) << "the reception is done with the description";
    gateway_->forget("cup");
    RawPoseFrame frame("cup", 1, 1000, 1);
    ASSERT_TRUE(eventually([&] {
        raw.write(frame.sample());
        return recorder_.count("info cup 1") == 2;
    }));
    EXPECT_TRUE(arrives(raw, frame, "pose cup 1000"));
}

TEST_F(GatewayTest, AMatchThatWasGivenUpKeepsItsEndpointsAndReturnsWithItsPoses) {
    RawPeer& raw = game("cup");
    gateway_->give_up("cup");
    RawPoseFrame frame("cup", 1, 7, 1);
    ASSERT_TRUE(eventually([&] {
        raw.write(frame.sample());
        return recorder_.count("info cup 1") == 2;
    }));
    // A pose still on its way would bring the match back too.
    ASSERT_TRUE(last_arrives(raw, "cup", 7));

    recorder_.accepts = false;
    gateway_->give_up("cup");
    raw.write(test::raw_request("cup", "anna", 1));
    ASSERT_TRUE(eventually([&] { return recorder_.has("request anna 1"); }));
    EXPECT_EQ(recorder_.count("info cup 1"), 2) << "a request does not bring it back";
    ASSERT_TRUE(eventually([&] {
        raw.write(frame.sample());
        return recorder_.count("info cup 1") > 2;
    }));
    raw.dispose(test::raw_match_info("cup", 1));
    EXPECT_TRUE(eventually([&] { return recorder_.has("over cup"); }));
    EXPECT_EQ(raw.directors(), 1U) << "for observers that wait";
}

TEST_F(GatewayTest, ARefusedMatchGetsNoEndpointsUntilThereIsRoom) {
    recorder_.accepts = false;
    RawPeer& raw = peer("cup");
    raw.write(test::raw_match_info("cup", 1));
    ASSERT_TRUE(eventually([&] { return recorder_.has("admit cup"); }));
    EXPECT_EQ(gateway_->counters().matches, 0U);
    EXPECT_FALSE(recorder_.has("info cup 1"));
    recorder_.accepts = true;
    EXPECT_TRUE(eventually([&] { return raw.directors() == 1 && recorder_.has("info cup 1"); }));
}

TEST_F(GatewayTest, ADirectorThatHangsStopsAssertingItsLiveliness) {
    game("cup");
    EXPECT_EQ(gateway_->counters().liveliness_withheld, 0U);
    recorder_.answers = false;
    EXPECT_TRUE(eventually([&] { return gateway_->counters().liveliness_withheld > 2; }));
}

TEST_F(GatewayTest, ReceptionThatHangsIsNotResponsiveUntilItGoesOn) {
    constexpr std::chrono::milliseconds late{100};
    RawPeer& raw = game("cup");
    EXPECT_TRUE(gateway_->responsive(test::patience));
    recorder_.hangs = true;
    raw.write(test::raw_match_info("cup", 2));
    EXPECT_TRUE(eventually([&] { return recorder_.has("info cup 2") && !gateway_->responsive(late); }));
    EXPECT_TRUE(gateway_->responsive(test::patience));
    recorder_.hangs = false;
    EXPECT_TRUE(eventually([&] { return gateway_->responsive(late); }));
    gateway_->stop_receiving();
    EXPECT_TRUE(gateway_->responsive(std::chrono::nanoseconds(0)));
}

// A whole batch of matches would take longer than a lease: a standby would take over all others.
TEST_F(GatewayTest, AssertsItsLivelinessBetweenMatchesThatBeginTogether) {
    RawPeer& raw = peer("a", {"match/a", "match/b", "match/c", "match/d", "match/e"});
    raw.write(test::raw_match_info("a", 1));
    ASSERT_TRUE(eventually([&] { return recorder_.has("info a 1"); }));
    recorder_.begins_in = std::chrono::milliseconds(config_.lease_ms);
    const int before = recorder_.questions;
    for (const char* id : {"b", "c", "d", "e"})
        raw.write(test::raw_match_info(id, 1));
    const auto begun = [&] {
        return std::ranges::count_if(recorder_.lines(),
                                     [](const std::string& line) { return line.starts_with("info"); }) -
               1;
    };
    for (int match = 1; match <= 4; ++match) {
        ASSERT_TRUE(eventually([&] { return begun() >= match; }));
        EXPECT_GE(recorder_.questions, before + match - 1);
    }
}

TEST_F(GatewayTest, ClosingReleasesTheMatchesAndNothingIsReceivedAfterStopping) {
    RawPeer& raw = led_game("cup");
    gateway_->publish("cup", one_camera(0));
    gateway_->publish(status_of("anna", ""));
    ASSERT_TRUE(eventually([&] { return raw.statuses().size() == 1; }));

    gateway_->stop_receiving();
    const auto before = recorder_.lines();
    raw.write(test::raw_match_info("cup", 2));
    gateway_->publish("cup", one_camera(1));
    std::size_t frames = 0;
    EXPECT_TRUE(eventually([&] { return (frames += raw.take_cameras().size()) == 2; }));
    gateway_->close();
    EXPECT_TRUE(eventually([&] { return raw.directors() == 0 && raw.statuses().empty(); }));
    EXPECT_EQ(recorder_.lines(), before);
}

TEST_F(GatewayTest, ManyMatchesComeAndGoAtOnce) {
    constexpr int matches = 40;
    std::vector<RawPeer*> raws;
    for (int i = 0; i < matches; ++i)
        raws.push_back(&game("m" + std::to_string(i)));
    EXPECT_EQ(gateway_->counters().matches, 40U);
    for (int i = 0; i < matches; ++i) {
        const std::string id = "m" + std::to_string(i);
        RawPoseFrame frame(id, 1, 1, 8);
        EXPECT_TRUE(arrives(*raws[static_cast<std::size_t>(i)], frame, "pose " + id + " 1"));
    }
    for (int i = 0; i < matches; ++i) {
        const std::string id = "m" + std::to_string(i);
        raws[static_cast<std::size_t>(i)]->dispose(test::raw_match_info(id, 1));
        ASSERT_TRUE(eventually([&] { return recorder_.has("over " + id); }));
        gateway_->forget(id);
    }
    EXPECT_TRUE(eventually([&] { return gateway_->counters().matches == 0U; }));
}

}  // namespace
}  // namespace camdir::dds
