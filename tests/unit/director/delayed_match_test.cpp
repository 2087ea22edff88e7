// Matches that are shown with a delay, in real time.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <thread>

#include "camera/tracker.hpp"
#include "director/clock.hpp"
#include "stage.hpp"
#include "support/eventually.hpp"

namespace camdir::director {
namespace {

using test::eventually;
using testing::HasSubstr;

MatchInfo delayed_by(float seconds, std::uint64_t epoch = 1) {
    MatchInfo info = Stage::info("m", epoch);
    info.spectator_delay_s = seconds;
    return info;
}

config::Config with_minimum(double seconds) {
    config::Config config = Stage::default_config();
    config.matches.minimum_delay_s = seconds;
    return config;
}

TEST(DelayedMatch, NothingIsPublishedOrViewedEarly) {
    Stage stage(with_minimum(0.3));
    const std::int64_t begin = now_ns();
    stage.start(delayed_by(0.2F));
    stage.ask(Stage::request("a"));
    stage.ask(Stage::request("b", 9));
    for (std::uint32_t number = 0; number < 4; ++number)
        stage.send(Stage::poses(number));
    const auto shown = [&] {
        const auto frames = stage.publisher.frames();
        const View view = stage.director.view(std::chrono::seconds(30));
        const ObserverStatus own = stage.publisher.status("a");
        const ObserverStatus other = stage.publisher.status("b");
        const auto info = stage.publisher.shown();
        if (now_ns() - begin < 300 * ms) {
            EXPECT_TRUE(frames.empty());
            EXPECT_FALSE(info);
            EXPECT_EQ(own.state, RequestState::waiting_for_map);
            EXPECT_EQ(other.state, RequestState::waiting_for_map) << "who plays is not known yet";
            EXPECT_THAT(own.reason, HasSubstr("shown with a delay of 0.3 s: the cameras begin at 20"));
            EXPECT_THAT(own.reason, HasSubstr(" UTC"));
            EXPECT_EQ(own.epoch, 1U);
            EXPECT_EQ(view.matches.at(0).state, "filling the delay");
            EXPECT_EQ(view.matches.at(0).map_name, "");
            EXPECT_EQ(view.matches.at(0).players.size(), 0U);
            EXPECT_EQ(view.matches.at(0).delay_s, 0.3);
        }
        return !frames.empty() && frames.back().pose_number == 3;
    };
    EXPECT_TRUE(eventually(shown));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    EXPECT_EQ(stage.publisher.status("b").state, RequestState::waiting_for_player);
    EXPECT_EQ(stage.director.view(std::chrono::seconds(30)).matches.at(0).players.size(), 3U);
    stage.ask(Stage::request("late"));
    EXPECT_EQ(stage.publisher.status("late").state, RequestState::accepted) << "at once";
}

TEST(DelayedMatch, IsShownToItsEnd) {
    Stage stage;
    stage.start(delayed_by(0.2F));
    stage.ask(Stage::request("a"));
    for (std::uint32_t number = 0; number < 3; ++number)
        stage.send(Stage::poses(number));
    stage.director.match_ended("m");
    stage.director.flush();
    EXPECT_TRUE(eventually([&] {
        const auto frames = stage.publisher.frames();
        return !frames.empty() && frames.back().pose_number == 2;
    }));
    EXPECT_TRUE(
        eventually([&] { return stage.publisher.status("a").reason == "no game server runs this match"; }));
    EXPECT_FALSE(stage.publisher.shown());
    stage.director.request_ended("m", "a");
    EXPECT_TRUE(eventually([&] { return stage.publisher.forgotten("m"); }));
}

// Observers take no answers of an epoch before its description.
TEST(DelayedMatch, ARefusedEpochIsAnsweredAsOfTheOneThatWasShown) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    ASSERT_EQ(stage.publisher.shown()->epoch, 1U);
    stage.start(delayed_by(121.0F, 2));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::refused);
    EXPECT_EQ(stage.publisher.status("a").epoch, 1U);
    EXPECT_EQ(stage.publisher.shown()->epoch, 1U);
    stage.start(delayed_by(0.1F, 3));
    EXPECT_TRUE(eventually([&] { return stage.publisher.shown()->epoch == 3; }));
    EXPECT_TRUE(eventually([&] { return stage.publisher.status("a").epoch == 3; }));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
}

TEST(DelayedMatch, AnEndedMatchWithoutObserversIsKeptUntilItIsShown) {
    Stage stage;
    stage.start(delayed_by(2.0F));
    stage.send(Stage::poses(1));
    stage.director.match_ended("m");
    stage.ask(Stage::request("a"));
    EXPECT_TRUE(eventually([&] { return !stage.publisher.frames().empty(); }));
}

TEST(DelayedMatch, ADelayThatIsTooLongIsRefused) {
    Stage stage;
    stage.ask(Stage::request("a"));
    stage.start(delayed_by(121.0F, 7));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::refused);
    EXPECT_EQ(stage.publisher.status("a").reason,
              "a delay of 121 s is wanted; the longest possible is 120 s");
    EXPECT_EQ(stage.publisher.status("a").epoch, 7U);
    EXPECT_EQ(stage.director.statistics()[Counter::refused_matches_delay], 1U);
    stage.send(Stage::poses(1, 7));
    EXPECT_EQ(stage.director.statistics()[Counter::drop_delay], 1U);
    stage.start(delayed_by(0.1F, 7));
    EXPECT_NE(stage.publisher.status("a").state, RequestState::refused);
    stage.send(Stage::poses(2, 7));
    EXPECT_TRUE(eventually([&] { return stage.publisher.frames().size() == 1; }));
    EXPECT_EQ(stage.publisher.frames()[0].pose_number, 2U);

    stage.start(delayed_by(500.0F, 8));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::refused);
    stage.director.server_lost("m");
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("a").reason, "no game server runs this match");
    EXPECT_EQ(stage.director.statistics().matches, 0U);
}

TEST(DelayedMatch, AReloadedMinimumHoldsTheMatchBack) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    stage.send(Stage::poses(1));
    ASSERT_EQ(stage.publisher.frames().size(), 1U);
    const std::int64_t reloaded = now_ns();
    stage.director.reconfigure(with_minimum(0.3));
    stage.send(Stage::poses(2));
    EXPECT_TRUE(eventually([&] {
        const bool shown = stage.publisher.frames().size() == 2;
        EXPECT_FALSE(shown && now_ns() - reloaded < 300 * ms);
        return shown;
    }));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    EXPECT_EQ(stage.director.statistics()[Counter::silences], 0U);
}

// A refusal drops what waits, also the match's description.
TEST(DelayedMatch, IsShownAgainWhenAReloadEndsItsRefusal) {
    config::Config config = with_minimum(100.0);
    config.limits.delay_mib = 1;
    Stage stage(config);
    stage.start();
    stage.ask(Stage::request("a"));
    std::uint32_t number = 0;
    while (stage.publisher.status("a").state != RequestState::refused && number < 20'000)
        stage.send(Stage::poses(number++));
    ASSERT_EQ(stage.publisher.status("a").state, RequestState::refused);
    EXPECT_THAT(stage.publisher.status("a").reason, HasSubstr("limits.delay_mib"));
    config.matches.minimum_delay_s = 0.2;
    stage.director.reconfigure(config);
    EXPECT_TRUE(eventually([&] {
        stage.send(Stage::poses(number++));
        return !stage.publisher.frames().empty();
    }));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
}

constexpr std::uint32_t recorded = 40;     // frames
constexpr float recording_delay_s = 3.0F;  // no busy machine sends the recording so late

// The cameras of the recording, shown with a delay by so many workers.
std::vector<CameraFrame> shown_by(std::int64_t workers) {
    config::Config config = Stage::default_config();
    config.limits.workers = workers;
    Stage stage(config);
    stage.start(delayed_by(recording_delay_s));
    for (const std::uint32_t target : {1U, 2U, 3U})
        stage.ask(Stage::request("observer " + std::to_string(target), target));
    for (std::uint32_t number = 0; number < recorded; ++number) {
        receive(stage.director, "m", Stage::poses(number));
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    EXPECT_TRUE(eventually([&] {
        const auto shown = stage.publisher.frames();
        return !shown.empty() && shown.back().pose_number + 1 == recorded;
    }));
    return stage.publisher.frames();
}

double recorded_at(std::uint32_t number) {
    return seconds_between(0, Stage::poses(number).frame_time);
}

ShotCamera camera_of(const CameraFrame& frame, std::size_t player) {
    const auto found = std::ranges::find(frame.cameras, player, &ShotCamera::target);
    EXPECT_NE(found, frame.cameras.end());
    return found == frame.cameras.end() ? ShotCamera{} : *found;
}

// One tracker over the whole recording, as far as the delay lets it be known at each of the frames shown.
std::vector<Vec3f> planned(std::uint32_t player, const std::vector<CameraFrame>& shown) {
    constexpr double ahead = 2.5;  // s, that are used of a long delay
    const freespace::Freespace square = Stage::square();
    camera::Scratch scratch(square);
    std::map<std::uint32_t, std::vector<camera::TimedPose>> tracks;
    for (std::uint32_t number = 0; number < recorded; ++number)
        for (const PlayerPose& pose : Stage::poses(number).poses)
            tracks[pose.player_id].push_back(
                {recorded_at(number), {pose.eye, pose.orientation, pose.velocity, true, false}, true});
    camera::ShotState state;
    state.time = recorded_at(shown.at(0).pose_number) - 1.0 / 60.0;
    state.plan.phase = camera_of(shown.at(0), player).camera_id;
    std::vector<Vec3f> cameras;
    for (const CameraFrame& frame : shown) {
        const double now = recorded_at(frame.pose_number);
        const auto known = [&](std::span<const camera::TimedPose> track) {
            std::size_t count = 0;
            while (count < track.size() && track[count].time - now <= ahead)
                ++count;
            return track.first(count);
        };
        std::vector<camera::Crowd::Player> crowd;
        for (const auto& [id, track] : tracks)
            crowd.push_back({id, known(track)});
        cameras.push_back(camera::step(square, camera::Profile(), known(tracks[player]), now, state, scratch,
                                       {crowd, player})
                              .position);
    }
    return cameras;
}

TEST(DelayedMatch, CamerasArePlannedOverTheFutureWhateverTheNumberOfWorkers) {
    for (const std::int64_t workers : {1, 4}) {
        const auto shown = shown_by(workers);
        ASSERT_FALSE(shown.empty());
        for (std::size_t player = 1; player <= 3; ++player) {
            const auto expected = planned(static_cast<std::uint32_t>(player), shown);
            for (std::size_t i = 0; i < shown.size(); ++i) {
                EXPECT_EQ(camera_of(shown[i], player).position, expected[i])
                    << "frame " << shown[i].pose_number;
                EXPECT_EQ(shown[i].source_time, Stage::poses(shown[i].pose_number).source_time);
            }
        }
    }
}

}  // namespace
}  // namespace camdir::director
