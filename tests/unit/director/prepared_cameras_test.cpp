// Cameras of delayed frames are computed before the frames are due, and leave when they are.
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "delayed_times.hpp"

namespace camdir::director {
namespace {

TEST(PreparedCameras, LeaveWhenTheyAreDueAndInOrder) {
    DelayedTimes match;
    match.put_frames(10);
    match.put(MatchEnded{}, received(9));
    match.at(due(0));
    ASSERT_EQ(match.steps(), 1U) << "the first, with which the shot begins";
    for (std::uint32_t number = 1; number < 10; ++number) {
        match.at(due(number) - lead_ns - 1);
        EXPECT_EQ(match.steps(), number);
        match.at(due(number) - lead_ns);
        EXPECT_EQ(match.steps(), number + 1) << "it is computed";
        match.at(due(number) - 1);
        EXPECT_EQ(match.shown(), number) << "but not shown";
        EXPECT_TRUE(match.publisher.shown()) << "neither is the end";
        match.at(due(number));
        ASSERT_EQ(match.shown(), number + 1);
        EXPECT_EQ(match.publisher.frames().back().pose_number, number);
        EXPECT_EQ(match.steps(), number + 1) << "not once more";
    }
    EXPECT_FALSE(match.publisher.shown());
}

TEST(PreparedCameras, AreAllComputedWhereTheyTakeManyTurns) {
    DelayedTimes match;
    for (int distance = 100; distance < 150; ++distance) {
        ObserverRequest request = Stage::request(std::to_string(distance));
        request.overrides = "{\"distance\": " + request.observer_id + "}";
        match.tell(request);
    }
    match.put_frames(2);
    match.at(due(0));
    ASSERT_EQ(match.steps(), 51U);
    match.at(due(1) - lead_ns);
    EXPECT_EQ(match.steps(), 102U);
    match.at(due(1));
    EXPECT_EQ(match.steps(), 102U);
    EXPECT_EQ(match.publisher.frames().back().cameras.size(), 51U);
}

TEST(PreparedCameras, WaitOnWhenTheDelayGrows) {
    DelayedTimes match;
    match.put_frames(3);
    match.at(due(0));
    match.at(due(1) - lead_ns);
    ASSERT_EQ(match.steps(), 2U);
    EXPECT_TRUE(match.delay().set_minimum(10.0, match.start() + due(1) - 1));
    match.tell(DelayChanged{});
    const std::int64_t due = received(1) + 10'000 * ms;
    match.at(due - 1);
    EXPECT_EQ(match.shown(), 1U);
    match.at(due);
    EXPECT_EQ(match.shown(), 2U);
    EXPECT_EQ(match.publisher.frames().back().pose_number, 1U);
}

TEST(PreparedCameras, AreDroppedWithARefusedDelay) {
    DelayedTimes match;
    match.put_frames(3);
    match.at(due(0));
    match.at(due(1) - lead_ns);
    ASSERT_EQ(match.steps(), 2U);
    EXPECT_TRUE(match.delay().set_minimum(500.0, match.start() + due(1) - 1));
    match.tell(DelayChanged{});
    EXPECT_EQ(match.publisher.status("a").state, RequestState::refused);
    match.at(1000 * 1000 * ms);
    EXPECT_EQ(match.shown(), 1U);
    EXPECT_TRUE(match.delay().set_minimum(0.0, match.start() + received(4)));
    match.tell(DelayChanged{});
    match.put_frame(4);
    match.at(due(4));
    ASSERT_EQ(match.shown(), 2U);
    EXPECT_EQ(match.publisher.frames().back().pose_number, 4U);
}

TEST(PreparedCameras, LeaveRequestsToBeAnsweredAtOnce) {
    DelayedTimes match;
    match.put_frames(3);
    match.at(due(0));
    match.at(due(1) - lead_ns);
    match.tell(Stage::request("b", 2));
    EXPECT_EQ(match.publisher.status("b").state, RequestState::accepted);
    match.tell(RequestEnded{"a"});
    match.at(due(1));
    ASSERT_EQ(match.publisher.frames().back().cameras.size(), 1U);
    EXPECT_EQ(match.publisher.frames().back().cameras[0].target, 2U);
}

using Plan = std::vector<std::pair<std::int64_t, std::optional<Message>>>;

// What is shown when the frames are released at these times, and the messages are told; with the cameras
// prepared, or not before they are due.
std::vector<CameraFrame> shown_by(const Plan& plan, bool prepared) {
    DelayedTimes match;
    match.tell(Stage::request("automatic", no_player));
    for (std::uint32_t number = 0; number < 60; ++number) {
        if (number % 7 == 0)
            match.put(MatchEvent{1, Stage::poses(number).frame_time, 1, number % 3 + 1, number % 2 + 1, 1.0F},
                      received(number));
        match.put_frame(number);
    }
    for (const auto& [time, message] : plan) {
        if (prepared || match.any_due(time)) match.at(time);
        if (message) match.tell(*message);
    }
    return match.publisher.frames();
}

Message random_message(std::mt19937& random) {
    config::Config config = Stage::default_config();
    config.profiles["default"].distance = 60.0F + static_cast<float>(random() % 3) * 30.0F;
    switch (random() % 4) {
        case 0:
            return Reconfigured{std::make_shared<config::Config>(config)};
        case 1:
            return Stage::request("b", 1 + static_cast<std::uint32_t>(random() % 3));
        case 2:
            return RequestEnded{"b"};
        default:
            return ServerLost{};
    }
}

TEST(PreparedCameras, AreThoseThatWouldBeComputedWhenDue) {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
        Plan plan;
        std::int64_t time = delay_ns - 100 * ms;
        while (time < due(60)) {  // a step above 100 ms makes frames superseded
            time += static_cast<std::int64_t>(random() % (random() % 16 == 0 ? 300 : 20)) * ms;
            plan.emplace_back(time, std::nullopt);
            if (random() % 8 == 0) plan.back().second = random_message(random);
        }
        const auto prepared = shown_by(plan, true);
        const auto direct = shown_by(plan, false);
        ASSERT_EQ(prepared.size(), direct.size());
        ASSERT_GT(prepared.size(), 20U);
        for (std::size_t i = 0; i < prepared.size(); ++i) {
            ASSERT_EQ(prepared[i].pose_number, direct[i].pose_number);
            ASSERT_EQ(prepared[i].cameras.size(), direct[i].cameras.size());
            for (std::size_t c = 0; c < prepared[i].cameras.size(); ++c) {
                const ShotCamera& a = prepared[i].cameras[c];
                const ShotCamera& b = direct[i].cameras[c];
                ASSERT_EQ(a.camera_id, b.camera_id);
                ASSERT_EQ(a.target, b.target);
                ASSERT_EQ(a.flags, b.flags);
                ASSERT_EQ(a.position, b.position) << "frame " << prepared[i].pose_number;
                ASSERT_EQ(a.orientation.coeffs(), b.orientation.coeffs());
            }
        }
    }
}

}  // namespace
}  // namespace camdir::director
