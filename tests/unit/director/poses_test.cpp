// Pose frames as game servers send them: held up, too many, and how long they take to become cameras.
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <numeric>
#include <span>
#include <thread>
#include <vector>

#include "director/clock.hpp"
#include "director/director.hpp"
#include "director/inbox.hpp"
#include "stage.hpp"

namespace camdir::director {
namespace {

TEST(Poses, PosesThatWereHeldUpAllMoveTheCameras) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("o"));
    constexpr std::int64_t interval = 200 * ms;
    std::vector<PoseArrival> held_up;
    for (std::uint32_t number = 0; number <= Inbox::max_frames; ++number) {
        held_up.push_back({"m", Stage::poses(number + 1)});
        held_up.back().frame.source_time = 1000 * ms + interval * number;
    }
    stage.director.receive(std::span(held_up).first(1));  // punctually
    stage.director.flush();
    std::this_thread::sleep_for(std::chrono::nanoseconds(interval * Inbox::max_frames));
    stage.director.receive(std::span(held_up).subspan(1));
    stage.director.flush();
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), held_up.size());
    for (std::uint32_t i = 0; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].frame_number, i);
        EXPECT_EQ(frames[i].pose_number, i + 1);
        ASSERT_EQ(frames[i].cameras.size(), 1U);
    }
}

TEST(Poses, ObserversAreToldARateThoughTheGameServerStatesNone) {
    for (const float stated : {0.0F, -1.0F, std::numeric_limits<float>::quiet_NaN()}) {
        Stage stage;
        MatchInfo info = Stage::info();
        info.rate_hz = stated;
        stage.start(info);
        EXPECT_EQ(stage.publisher.shown()->rate_hz, 30.0F);
    }
}

TEST(Poses, AGameServerThatSendsTooFastHasNoMoreCamerasThanOthersMay) {
    config::Config config = Stage::default_config();
    config.limits.pose_rate_hz = 2;
    Stage stage(config);
    const std::int64_t begin = now_ns();
    stage.start();
    stage.ask(Stage::request("o"));
    EXPECT_EQ(stage.publisher.shown()->rate_hz, 2.0F);
    for (std::uint32_t number = 1; number <= 200; ++number)
        stage.send(Stage::poses(number));
    const std::size_t frames = stage.publisher.frames().size();
    EXPECT_GE(frames, 8U);
    EXPECT_LE(static_cast<double>(frames), 9.0 + 2.1e-9 * static_cast<double>(now_ns() - begin));
    EXPECT_EQ(frames + stage.director.statistics()[Counter::drop_rate], 200U);
}

TEST(Poses, AMatchIsSilentByTheRateAtWhichItIsServed) {
    config::Config config = Stage::default_config();
    config.matches.silence_frames = 30;
    config.limits.pose_rate_hz = 150;
    const Stage stage(config);
    MatchInfo info = Stage::info();
    info.rate_hz = 60.0F;
    EXPECT_EQ(stage.director.silence_limit(info), std::chrono::milliseconds(500));
    info.rate_hz = 1000.0F;
    EXPECT_EQ(stage.director.silence_limit(info), std::chrono::milliseconds(200));
}

TEST(Poses, CountsTheStagesOfItsLatency) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", 1));
    for (std::uint32_t frame = 1; frame <= 3; ++frame)
        stage.send(Stage::poses(frame));
    const Statistics statistics = stage.director.statistics();
    const auto count = [](const Durations& durations) {
        return std::accumulate(durations.buckets.begin(), durations.buckets.end(), std::uint64_t{0});
    };
    EXPECT_EQ(count(statistics.latency), 3U);
    for (const Durations* stage_of : {&statistics.waiting, &statistics.computing, &statistics.writing})
        EXPECT_EQ(count(*stage_of), 3U);
    EXPECT_NEAR(statistics.waiting.sum_s + statistics.computing.sum_s + statistics.writing.sum_s,
                statistics.latency.sum_s, 1e-9);
}

}  // namespace
}  // namespace camdir::director
