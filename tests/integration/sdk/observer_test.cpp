// The observer's functions against a fake director.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <camera_director/camera_director.hpp>

#include <array>
#include <future>
#include <memory>

#include "fake_director.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

namespace cd = camera_director;
using testing::ElementsAre;

class Spectator : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(eventually(
            [&] { return director_.observer_count() == 1 && observer_.counters().value().directors == 1; }));
    }

    // Camera 3 belongs to another shot; camera 4 is the observer's, at x.
    [[nodiscard]] CameraFrameArrays frame(std::uint64_t epoch, std::uint32_t number, float x,
                                          std::uint32_t flags = 0) const {
        CameraFrameArrays frame{.match_id = match_id_};
        frame.epoch = epoch;
        frame.frame_number = number;
        frame.pose_number = 2 * number;
        frame.frame_time = number * 16 * ms;
        frame.source_time = 5;
        frame.write_time = 6;
        frame.director_id = 77;
        frame.add_camera(3, -1.0F);
        frame.add_camera(4, x, flags);
        return frame;
    }

    void write(std::uint64_t epoch, std::uint32_t number, float x, std::uint32_t flags = 0) {
        CameraFrameArrays arrays = frame(epoch, number, x, flags);
        director_.write(arrays);
    }

    // Polls until the observer has taken this number of frames in total.
    [[nodiscard]] bool sees(std::uint64_t frames) {
        return eventually([&] {
            observer_.poll().value();
            return observer_.counters().value().frames == frames;
        });
    }

    void have_shot_accepted(std::uint64_t epoch) {
        observer_.request({.target = 104}).value();
        ASSERT_TRUE(eventually([&] { return director_.take_request().has_value(); }));
        director_.write_status("anna", epoch, CDIR_SHOT_ACCEPTED, 4);
        ASSERT_TRUE(eventually([&] {
            observer_.poll().value();
            return observer_.shot_status().value().state == CDIR_SHOT_ACCEPTED;
        }));
    }

    const std::string match_id_ = testing::UnitTest::GetInstance()->current_test_info()->name();
    cd::Context context_ = cd::Context::open({.domain = shared_domain}).value();
    FakeDirector director_{shared_domain, match_id_};
    cd::Observer observer_ = cd::Observer::open(context_, match_id_, "anna").value();
};

TEST_F(Spectator, RequestArrivesWithAllItsFields) {
    observer_
        .request({.target = 9, .group = {1, 9, 4}, .profile = "shoulder", .overrides = R"({"distance": 90})"})
        .value();
    std::optional<ReceivedRequest> request;
    ASSERT_TRUE(eventually([&] { return (request = director_.take_request()).has_value(); }));
    EXPECT_EQ(request->observer_id, "anna");
    EXPECT_EQ(request->target, 9U);
    EXPECT_THAT(request->group, ElementsAre(1, 9, 4));
    EXPECT_EQ(request->profile, "shoulder");
    EXPECT_EQ(request->overrides, R"({"distance": 90})");

    EXPECT_EQ(request->team, 0U);

    observer_.request({.team = 2}).value();
    ASSERT_TRUE(eventually([&] { return (request = director_.take_request()).has_value(); }));
    EXPECT_EQ(request->target, CDIR_CHOOSE_TARGET);
    EXPECT_THAT(request->group, testing::IsEmpty());
    EXPECT_EQ(request->team, 2U);

    EXPECT_FALSE(director_.request_has_ended());
    observer_.withdraw().value();
    EXPECT_TRUE(eventually([&] { return director_.request_has_ended(); }));
    EXPECT_THROW(observer_.withdraw().value(), cd::Error);
}

TEST_F(Spectator, RequestEndsWithItsObserver) {
    std::optional<cd::Observer> other = cd::Observer::open(context_, match_id_, "bert").value();
    other->request({.target = 1}).value();
    ASSERT_TRUE(eventually([&] { return director_.take_request().has_value(); }));
    other.reset();
    EXPECT_TRUE(eventually([&] { return director_.request_has_ended(); }));
}

TEST_F(Spectator, AnAnswerThatIsWithdrawnBeforeThePollIsWithdrawn) {
    have_shot_accepted(1);
    // Within one process samples arrive when they are written.
    director_.write_status("anna", 1, CDIR_SHOT_WAITING_FOR_PLAYER, 4);
    director_.withdraw_status("anna");
    observer_.poll().value();
    EXPECT_EQ(observer_.shot_status().value().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
}

TEST_F(Spectator, AnswersAndCamerasArrive) {
    EXPECT_EQ(observer_.shot_status().value().state, static_cast<std::uint32_t>(CDIR_SHOT_NOT_REQUESTED));
    observer_.request({.target = 104}).value();
    EXPECT_EQ(observer_.shot_status().value().state, static_cast<std::uint32_t>(CDIR_SHOT_UNANSWERED));
    director_.write_status("anna", 1, CDIR_SHOT_WAITING_FOR_PLAYER, 4, "no pose of player 104");
    ASSERT_EQ(observer_.wait(std::chrono::seconds(30)).value(), cd::Waited::arrived);
    observer_.poll().value();
    EXPECT_EQ(observer_.shot_status().value().state,
              static_cast<std::uint32_t>(CDIR_SHOT_WAITING_FOR_PLAYER));
    EXPECT_STREQ(observer_.shot_status().value().reason, "no pose of player 104");
    EXPECT_FALSE(observer_.newest_camera().value());

    write(1, 0, 10.0F, CDIR_CAMERA_CUT | CDIR_CAMERA_TARGET_VISIBLE);
    write(1, 1, 14.0F, CDIR_CAMERA_TARGET_VISIBLE);
    ASSERT_TRUE(sees(2));
    const std::optional<cd::View> newest = observer_.newest_camera().value();
    ASSERT_TRUE(newest);
    EXPECT_EQ(newest->frame_time, 16 * ms);
    EXPECT_EQ(newest->camera.camera_id, 4U);
    EXPECT_EQ(newest->camera.target, 104U);
    EXPECT_EQ(newest->camera.position[0], 14.0F);
    EXPECT_EQ(newest->camera.flags, static_cast<std::uint32_t>(CDIR_CAMERA_TARGET_VISIBLE));
    EXPECT_FLOAT_EQ(observer_.camera_at(4 * ms).value()->camera.position[0], 11.0F);
    EXPECT_EQ(observer_.camera_at(20 * ms).value()->late, 4 * ms);
    const auto time = observer_.display_time().value();
    ASSERT_TRUE(time);
    EXPECT_LE(*time, 16 * ms);
}

TEST_F(Spectator, BroadcasterTakesEveryFrameWithAllCameras) {
    for (std::uint32_t i = 0; i < 5; ++i) {
        write(1, i, static_cast<float>(i));
    }
    std::array<cd::Camera, 8> cameras{};
    for (std::uint32_t i = 0; i < 5; ++i) {
        std::optional<cd::CameraFrame> taken;
        ASSERT_TRUE(eventually([&] { return (taken = observer_.next_frame(cameras).value()).has_value(); }));
        EXPECT_EQ(taken->frame_number, i);
        EXPECT_EQ(taken->pose_number, 2 * i);
        EXPECT_EQ(taken->epoch, 1U);
        EXPECT_EQ(taken->director_id, 77U);
        EXPECT_EQ(taken->frame_time, i * 16 * ms);
        EXPECT_EQ(taken->source_time, 5);
        EXPECT_EQ(taken->write_time, 6);
        ASSERT_EQ(taken->camera_count, 2U);
        EXPECT_EQ(cameras[0].camera_id, 3U);
        EXPECT_EQ(cameras[1].camera_id, 4U);
        EXPECT_THAT(cameras[1].position, ElementsAre(static_cast<float>(i), 2.0F, 3.0F));
        EXPECT_THAT(cameras[1].orientation, ElementsAre(0.0F, 0.0F, 0.0F, 1.0F));
        EXPECT_EQ(cameras[1].vertical_fov, 1.0F);
        EXPECT_EQ(cameras[1].clearance, 8.0F);
    }
    EXPECT_FALSE(observer_.next_frame(cameras).value());

    write(1, 5, 1.0F);
    cdir_camera_frame header = cdir_camera_frame_default();
    std::array<cdir_camera, 2> pair = {cdir_camera_default(), {}};
    cdir_observer raw{};
    ASSERT_EQ(cdir_observer_open(context_.handle(), match_id_.c_str(), "raw", nullptr, &raw), CDIR_OK);
    ASSERT_TRUE(eventually([&] { return director_.observer_count() == 2; }));
    write(1, 6, 1.0F);
    cdir_status status = CDIR_NO_DATA;
    ASSERT_TRUE(eventually([&] {
        status = cdir_observer_next_frame(raw, &header, pair.data(), 1);
        return status != CDIR_NO_DATA;
    }));
    EXPECT_EQ(status, CDIR_TRUNCATED);
    EXPECT_EQ(header.camera_count, 2U);
    EXPECT_EQ(pair[0].camera_id, 3U);
    EXPECT_EQ(pair[1].camera_id, 0U) << "written beyond the capacity";
    EXPECT_EQ(cdir_observer_close(raw), CDIR_OK);
}

TEST_F(Spectator, FramesBeyondTheHistoryAreCountedAsGaps) {
    have_shot_accepted(1);
    write(1, 0, 0.0F);
    ASSERT_TRUE(sees(1));
    for (std::uint32_t i = 1; i <= 40; ++i) {
        write(1, i, static_cast<float>(i));
    }
    ASSERT_TRUE(eventually([&] {
        observer_.poll().value();
        return observer_.newest_camera().value()->camera.position[0] == 40.0F;
    }));
    EXPECT_EQ(observer_.counters().value().frames, 33U);
    EXPECT_EQ(observer_.counters().value().gaps, 8U);
    EXPECT_EQ(observer_.camera_at(5 * 16 * ms).value()->camera.position[0], 0.0F)
        << "a cut may hide in the gap";
}

TEST_F(Spectator, OlderEpochsAreDropped) {
    have_shot_accepted(2);
    write(2, 5, 1.0F);
    ASSERT_TRUE(sees(1));
    write(1, 6, 2.0F);
    director_.write_status("anna", 1, CDIR_SHOT_REFUSED, 0);
    write(2, 6, 3.0F);
    ASSERT_TRUE(sees(2));
    ASSERT_TRUE(eventually([&] {
        observer_.poll().value();
        return observer_.counters().value().stale_epoch == 2;
    }));
    EXPECT_EQ(observer_.newest_camera().value()->camera.position[0], 3.0F);
    EXPECT_EQ(observer_.shot_status().value().state, static_cast<std::uint32_t>(CDIR_SHOT_ACCEPTED));
    write(3, 0, 4.0F);
    ASSERT_TRUE(sees(3));
    EXPECT_FALSE(observer_.newest_camera().value()) << "the answer of epoch 2 names no camera of epoch 3";
}

TEST_F(Spectator, MalformedFrameIsDroppedAndCounted) {
    have_shot_accepted(1);
    CameraFrameArrays broken = frame(1, 0, 1.0F);
    broken.position.pop_back();
    director_.write(broken);
    write(1, 1, 2.0F);
    ASSERT_TRUE(sees(1));
    EXPECT_EQ(observer_.counters().value().invalid, 1U);
    EXPECT_EQ(observer_.newest_camera().value()->camera.position[0], 2.0F);
}

TEST_F(Spectator, OnlyTheStrongestDirectorIsReceived) {
    have_shot_accepted(1);
    FakeDirector leader(shared_domain, match_id_, 100);
    ASSERT_TRUE(eventually(
        [&] { return leader.observer_count() == 1 && observer_.counters().value().directors == 2; }));
    CameraFrameArrays led = frame(1, 0, 50.0F);
    led.director_id = 78;
    leader.write(led);
    ASSERT_TRUE(sees(1));
    write(1, 0, 1.0F);
    led.frame_number = 1;
    led.frame_time += 16 * ms;
    leader.write(led);
    ASSERT_TRUE(sees(2));
    EXPECT_EQ(observer_.newest_camera().value()->camera.position[0], 50.0F);
    EXPECT_EQ(observer_.counters().value().hand_overs, 0U);
}

TEST_F(Spectator, TheStandbyIsReceivedWhenTheLeaderIsGone) {
    have_shot_accepted(1);
    std::optional<FakeDirector> leader(std::in_place, shared_domain, match_id_, 100);
    ASSERT_TRUE(eventually(
        [&] { return leader->observer_count() == 1 && observer_.counters().value().directors == 2; }));
    CameraFrameArrays led = frame(1, 0, 50.0F);
    led.director_id = 78;
    leader->write(led);
    ASSERT_TRUE(sees(1));
    leader.reset();
    ASSERT_TRUE(eventually([&] { return observer_.counters().value().directors == 1; }));
    write(1, 1, 51.0F);
    ASSERT_TRUE(sees(2));
    EXPECT_EQ(observer_.counters().value().hand_overs, 1U);
    EXPECT_EQ(observer_.counters().value().gaps, 0U);
}

TEST_F(Spectator, MatchAndPlayersAreKnownFromWhenADirectorShowsThemToTheEnd) {
    const cd::Match match =
        cd::Match::open(context_, cd::MatchInfo{.match_id = match_id_,
                                                .map_name = "oa_dm1",
                                                .players = {{1, "anna", "medic", 3}, {2, "bert"}}})
            .value();
    ASSERT_TRUE(eventually([&] { return match.director_count().value() == 1; }));
    observer_.poll().value();
    EXPECT_FALSE(observer_.match_info().value()) << "not from the game server";
    std::optional<FakeDirector> leader(std::in_place, shared_domain, match_id_, 100);
    ASSERT_TRUE(eventually([&] { return leader->show_match(); }));
    ASSERT_TRUE(eventually([&] {
        observer_.poll().value();
        return observer_.match_info().value().has_value();
    }));
    const cd::MatchInfo info = *observer_.match_info().value();
    EXPECT_EQ(info.match_id, match_id_);
    EXPECT_EQ(info.map_name, "oa_dm1");
    EXPECT_EQ(info.rate_hz, 60.0F);
    ASSERT_EQ(info.players.size(), 2U);
    EXPECT_EQ(info.players[0].name, "anna");
    EXPECT_EQ(info.players[0].player_class, "medic");
    EXPECT_EQ(info.players[0].team, 3U);
    EXPECT_EQ(info.players[1].id, 2U);

    leader.reset();
    ASSERT_TRUE(eventually([&] { return observer_.counters().value().directors == 1; }));
    observer_.poll().value();
    EXPECT_TRUE(observer_.match_info().value()) << "until another director's";
    ASSERT_TRUE(director_.show_match());
    director_.end_shown_match();
    EXPECT_TRUE(eventually([&] {
        observer_.poll().value();
        return !observer_.match_info().value();
    }));
}

// The next director's answer may have been dropped while the lost one owned the observer's status.
TEST_F(Spectator, TheRequestIsWrittenAgainWhenADirectorIsLost) {
    auto leader = std::make_unique<FakeDirector>(shared_domain, match_id_, 100);
    observer_.request({.target = 9, .group = {1, 9, 4}, .profile = "shoulder"}).value();
    ASSERT_TRUE(eventually([&] { return director_.take_request().has_value(); }));
    observer_.poll().value();
    EXPECT_FALSE(director_.take_request()) << "not before";
    leader.reset();
    EXPECT_EQ(observer_.wait(std::chrono::seconds(30)).value(), cd::Waited::arrived);
    std::optional<ReceivedRequest> request;
    EXPECT_TRUE(eventually([&] {
        observer_.poll().value();
        return (request = director_.take_request()).has_value();
    }));
    EXPECT_EQ(request->target, 9U);
    EXPECT_THAT(request->group, ElementsAre(1, 9, 4));
    EXPECT_EQ(request->profile, "shoulder");
    observer_.poll().value();
    EXPECT_FALSE(director_.take_request()) << "once";
}

TEST_F(Spectator, WaitEndsByTimeByInterruptAndByClose) {
    ASSERT_TRUE(eventually([&] {
        observer_.poll().value();  // takes note of the director
        return observer_.wait(std::chrono::nanoseconds(0)).value() == cd::Waited::timeout;
    }));
    EXPECT_EQ(observer_.wait(std::chrono::milliseconds(20)).value(), cd::Waited::timeout);
    observer_.interrupt().value();
    EXPECT_EQ(observer_.wait(std::chrono::seconds(-1)).value(), cd::Waited::interrupted);
    EXPECT_EQ(observer_.wait(std::chrono::nanoseconds(0)).value(), cd::Waited::timeout)
        << "one interrupt ends one wait";

    auto waiting =
        std::async(std::launch::async, [&] { return observer_.wait(std::chrono::seconds(-1)).value(); });
    observer_.interrupt().value();
    EXPECT_EQ(waiting.get(), cd::Waited::interrupted);

    cdir_observer raw{};
    ASSERT_EQ(cdir_observer_open(context_.handle(), "nobody's match", "raw", nullptr, &raw), CDIR_OK);
    std::promise<void> started;
    auto closed_under = std::async(std::launch::async, [&] {
        started.set_value();
        return cdir_observer_wait(raw, -1);
    });
    started.get_future().wait();
    EXPECT_EQ(cdir_observer_close(raw), CDIR_OK);
    const cdir_status status = closed_under.get();
    EXPECT_TRUE(status == CDIR_INTERRUPTED || status == CDIR_INVALID_HANDLE) << cdir_status_name(status);
}

TEST_F(Spectator, CallsFromManyThreadsDoNotDisturbEachOther) {
    have_shot_accepted(1);
    write(1, 0, 0.0F);
    ASSERT_TRUE(sees(1)) << "what is missing after the first frame is a gap";
    std::atomic<bool> stop{false};
    std::vector<std::future<void>> threads;
    for (int i = 0; i < 4; ++i) {
        threads.push_back(std::async(std::launch::async, [&, i] {
            const std::string own_id = "thread-" + std::to_string(i);
            while (!stop) {
                observer_.poll().value();
                (void)observer_.newest_camera().value();
                (void)observer_.display_time().value();
                (void)observer_.wait(std::chrono::milliseconds(1)).value();
                const cd::Observer own = cd::Observer::open(context_, match_id_, own_id).value();
            }
        }));
    }
    for (std::uint32_t i = 1; i < 100; ++i) {
        write(1, i, static_cast<float>(i));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(eventually([&] {
        const auto newest = observer_.newest_camera().value();
        return newest && newest->camera.position[0] == 99.0F;
    }));
    stop = true;
    for (auto& thread : threads) {
        thread.get();
    }
    EXPECT_EQ(observer_.counters().value().frames + observer_.counters().value().gaps, 100U);
}

}  // namespace
}  // namespace camdir::test
