// Requests and the answers to them.
#include "director/director.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "camera/camera.hpp"
#include "camera/view.hpp"
#include "director/inbox.hpp"
#include "stage.hpp"
#include "support/eventually.hpp"

namespace camdir::director {
namespace {

using test::eventually;
using testing::HasSubstr;

TEST(Director, AnAcceptedRequestHasACameraInEveryFrame) {
    Stage stage;
    ASSERT_TRUE(stage.start());
    stage.ask(Stage::request("o"));
    const ObserverStatus status = stage.publisher.status("o");
    EXPECT_EQ(status.state, RequestState::accepted);
    EXPECT_EQ(status.epoch, 1U);
    EXPECT_NE(status.camera_id, 0U);
    EXPECT_EQ(status.reason, "");

    for (std::uint32_t number = 10; number < 20; ++number)
        stage.send(Stage::poses(number));
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), 10U);
    for (std::uint32_t i = 0; i < frames.size(); ++i) {
        const CameraFrame& frame = frames[i];
        EXPECT_EQ(frame.epoch, 1U);
        EXPECT_EQ(frame.frame_number, i);
        EXPECT_EQ(frame.pose_number, 10 + i);
        EXPECT_EQ(frame.frame_time, Stage::poses(10 + i).frame_time);
        EXPECT_EQ(frame.source_time, Stage::poses(10 + i).source_time);
        ASSERT_EQ(frame.cameras.size(), 1U);
        EXPECT_EQ(frame.cameras[0].camera_id, status.camera_id);
        EXPECT_EQ(frame.cameras[0].target, 1U);
        EXPECT_GT(frame.cameras[0].clearance, 0.0F);
        EXPECT_EQ((frame.cameras[0].flags & camera::cut) != 0, i == 0);
    }
}

TEST(Director, AMatchWithoutShotsPublishesNothing) {
    Stage stage;
    stage.start();
    stage.send(Stage::poses(1));
    EXPECT_TRUE(stage.publisher.frames().empty());
    EXPECT_EQ(stage.director.statistics()[Counter::pose_frames], 1U);
}

TEST(Director, EqualRequestsShareACamera) {
    Stage stage;
    stage.start();
    ObserverRequest first = Stage::request("a");
    first.overrides = R"({"distance": 80, "vertical_fov": 50})";
    first.group = {3, 2};
    ObserverRequest second = Stage::request("b");
    second.overrides = R"(  {"vertical_fov":50,"distance":80}  )";
    second.group = {2, 3, 2};
    second.profile = "default";
    stage.ask(first);
    stage.ask(second);
    stage.ask(Stage::request("c"));
    stage.ask(Stage::request("d", 2));
    EXPECT_EQ(stage.publisher.status("a").camera_id, stage.publisher.status("b").camera_id);
    EXPECT_NE(stage.publisher.status("a").camera_id, stage.publisher.status("c").camera_id);
    EXPECT_NE(stage.publisher.status("c").camera_id, stage.publisher.status("d").camera_id);
    stage.send(Stage::poses(1));
    EXPECT_EQ(stage.publisher.frames().back().cameras.size(), 3U);
    EXPECT_EQ(stage.director.statistics().shots, 3U);
    EXPECT_EQ(stage.director.statistics().observers, 4U);
}

TEST(Director, AShotLastsAsLongAsARequestWantsIt) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a"));
    stage.ask(Stage::request("b"));
    const std::uint32_t id = stage.publisher.status("a").camera_id;
    stage.director.request_ended("m", "a");
    stage.director.flush();
    EXPECT_FALSE(stage.publisher.has_status("a"));
    stage.send(Stage::poses(1));
    EXPECT_EQ(stage.publisher.frames().back().cameras.at(0).camera_id, id);
    stage.director.request_ended("m", "b");
    stage.send(Stage::poses(2));
    EXPECT_EQ(stage.publisher.frames().size(), 1U);
    EXPECT_EQ(stage.director.statistics().shots, 0U);
}

TEST(Director, TwoDirectorsGiveAShotTheSameId) {
    Stage leader;
    Stage standby;
    for (Stage* stage : {&leader, &standby})
        stage->start();
    leader.ask(Stage::request("a", 1));
    leader.ask(Stage::request("b", 2));
    standby.ask(Stage::request("b", 2));
    standby.ask(Stage::request("a", 1));
    EXPECT_EQ(leader.publisher.status("a").camera_id, standby.publisher.status("a").camera_id);
    EXPECT_EQ(leader.publisher.status("b").camera_id, standby.publisher.status("b").camera_id);
}

TEST(Director, AChangedRequestChangesTheCamera) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", 1));
    stage.send(Stage::poses(1));
    stage.ask(Stage::request("a", 2));
    stage.send(Stage::poses(2));
    const auto frames = stage.publisher.frames();
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[1].cameras.at(0).target, 2U);
    EXPECT_EQ(frames[1].cameras.at(0).camera_id, stage.publisher.status("a").camera_id);
    EXPECT_NE(frames[1].cameras.at(0).flags & camera::cut, 0U);
}

TEST(Director, BadProfilesAndOverridesAreRefusedWithAReason) {
    Stage stage;
    stage.start();
    ObserverRequest request = Stage::request("a");
    request.profile = "cinematic";
    stage.ask(request);
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::refused);
    EXPECT_THAT(stage.publisher.status("a").reason, HasSubstr("no profile 'cinematic'; known: default"));

    request = Stage::request("b");
    request.overrides = R"({"distanze": 3})";
    stage.ask(request);
    EXPECT_EQ(stage.publisher.status("b").state, RequestState::refused);
    EXPECT_THAT(stage.publisher.status("b").reason, HasSubstr("did you mean \"distance\"?"));

    request.overrides = "{\"" + std::string(900, 'x') + "\": 1}";
    stage.ask(request);
    EXPECT_EQ(stage.publisher.status("b").reason.size(), 255U);
    EXPECT_EQ(stage.director.statistics()[Counter::refused_invalid], 3U);

    stage.ask(Stage::request("b"));
    EXPECT_EQ(stage.publisher.status("b").state, RequestState::accepted);
}

TEST(Director, ARequestForAnUnknownPlayerWaits) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", 9));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::waiting_for_player);
    EXPECT_EQ(stage.publisher.status("a").reason, "player 9 is not in the match");
    stage.send(Stage::poses(1));
    EXPECT_TRUE(stage.publisher.frames().empty());
    stage.send(Stage::poses(2, 1, {1, 9}));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    EXPECT_EQ(stage.publisher.frames().size(), 1U);

    stage.start(Stage::info("m", 1, {1, 2, 3}));
    for (std::uint32_t number = 3; number < 6; ++number)
        stage.send(Stage::poses(number));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted) << "seen recently";
}

TEST(Director, ARequestWaitsWhenItsPlayerHasLeft) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", 3));
    stage.send(Stage::poses(1));
    stage.send(Stage::poses(2, 1, {1, 2}));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted) << "still listed";
    EXPECT_NE(stage.publisher.frames().back().cameras.at(0).flags & camera::target_absent, 0U);
    stage.start(Stage::info("m", 1, {1, 2}));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::waiting_for_player);
    EXPECT_EQ(stage.publisher.status("a").camera_id, 0U);
}

TEST(Director, SpectatorsAreNotTracked) {
    Stage stage;
    stage.start();
    PoseFrame frame = Stage::poses(1);
    frame.poses[0].flags |= pose_spectator;
    stage.send(frame);
    stage.ask(Stage::request("a", 1));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::waiting_for_player);
    EXPECT_EQ(stage.publisher.status("a").reason, "player 1 is a spectator");
    stage.send(Stage::poses(2));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
}

TEST(Director, AnAutomaticShotCutsAndSaysWhy) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", no_player));
    stage.ask(Stage::request("pinned", 2));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    const std::uint32_t id = stage.publisher.status("a").camera_id;
    const auto automatic = [&] {
        const CameraFrame frame = stage.publisher.frames().back();
        EXPECT_EQ(frame.cameras.size(), 2U);
        const auto& cameras = frame.cameras;
        EXPECT_TRUE(cameras[0].target == 2U || cameras[1].target == 2U) << "a pinned camera stays";
        return cameras[cameras[0].camera_id == id ? 0 : 1];
    };
    stage.send(Stage::poses(1));
    const std::uint32_t first = automatic().target;
    ASSERT_EQ(stage.publisher.frames().back().reasons.size(), 1U);
    EXPECT_EQ(stage.publisher.frames().back().reasons[0].camera_id, id);
    EXPECT_EQ(stage.publisher.frames().back().reasons[0].reason.why, "opening");

    // No shot is longer than 14 s.
    std::uint32_t number = 2;
    for (; number < 400 && automatic().target == first; ++number) {
        if (number % 9 == 0)
            stage.director.receive("m", MatchEvent{1, Stage::poses(number).frame_time, 1, 3, first, 0.0F});
        stage.send(Stage::poses(number));
    }
    EXPECT_NE(automatic().target, first);
    EXPECT_NE(automatic().flags & camera::cut, 0U);
    ASSERT_EQ(stage.publisher.frames().back().reasons.size(), 1U);
    const Reason reason = stage.publisher.frames().back().reasons[0].reason;
    EXPECT_FALSE(reason.why.empty());
    EXPECT_NE(reason.why, "opening");

    const View view = stage.director.view(std::chrono::seconds(30));
    const auto& shots = view.matches.at(0).shots;
    const auto& shot = shots.at(shots.at(0).automatic ? 0 : 1);
    EXPECT_EQ(shot.reason.why, reason.why);
    EXPECT_EQ(shot.since, stage.publisher.frames().back().frame_time);

    // Those who come later are told within a second.
    std::size_t told = 0;
    for (const std::uint32_t end = number + 20; number < end; ++number) {
        stage.send(Stage::poses(number));
        told += stage.publisher.frames().back().reasons.size();
    }
    EXPECT_GE(told, 1U);
}

// Two enemies of whom each looks past the other: from behind either the picture is from another side.
TEST(Director, AnAutomaticCutBetweenEnemiesStaysOnItsSideOfTheLineOfAction) {
    Stage stage;
    stage.start();
    ObserverRequest wanted = Stage::request("a", no_player);
    wanted.group = {1, 2};
    stage.ask(wanted);
    const Vec3f eyes[] = {{20.0F, 50.0F, 0.0F}, {80.0F, 50.0F, 0.0F}};
    std::vector<ShotCamera> cameras;
    for (std::uint32_t number = 1; number < 400; ++number) {
        PoseFrame frame = Stage::poses(number, 1, {1, 2});
        for (std::size_t i = 0; i < 2; ++i) {
            frame.poses[i].eye = eyes[i];
            const float yaw = 0.7F + 3.14159F * static_cast<float>(i);
            frame.poses[i].orientation = Quatf(Eigen::AngleAxisf(yaw, Vec3f::UnitZ()));
        }
        stage.send(frame);
        cameras.push_back(stage.publisher.frames().back().cameras.at(0));
    }
    int cuts = 0;
    for (std::size_t i = 1; i < cameras.size(); ++i) {
        if (cameras[i].target == cameras[i - 1].target) continue;
        ++cuts;
        const auto side = [&](const ShotCamera& camera) { return camera.position.y() - eyes[0].y(); };
        EXPECT_GT(std::abs(side(cameras[i - 1])), 5.0F);
        EXPECT_GT(side(cameras[i - 1]) * side(cameras[i]), 0.0F) << i;
    }
    EXPECT_GE(cuts, 1) << "no shot is longer than 14 s";
}

TEST(Director, AFixedCameraStandsStillAndHasNoTarget) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", no_player));
    const auto newest = [&] { return stage.publisher.frames().back().cameras.at(0); };
    std::uint32_t number = 1;
    const auto send = [&] {
        if (number % 9 == 0)
            stage.director.receive("m", MatchEvent{1, Stage::poses(number).frame_time, 1, 3, 2, 0.0F});
        stage.send(Stage::poses(number++));
    };
    send();
    EXPECT_NE(newest().target, no_player) << "nothing is known yet";
    while (number < 2000 && newest().target != no_player)
        send();
    const freespace::FixedShot shot = Stage::square().fixed_shots()[0];
    ASSERT_EQ(newest().target, no_player);
    EXPECT_EQ(newest().flags, camera::cut);
    const ShotView view = stage.director.view(std::chrono::seconds(30)).matches.at(0).shots.at(0);
    EXPECT_EQ(view.fixed, 0U);
    std::uint32_t stays = 0;
    for (; number < 4000 && newest().target == no_player; ++stays) {
        EXPECT_EQ(newest().position, shot.position);
        EXPECT_TRUE(newest().orientation.isApprox(camera::orientation_of({shot.yaw, shot.pitch})));
        EXPECT_NEAR(std::tan(newest().vertical_fov / 2.0F), 9.0F / 16.0F, 1e-6F);
        EXPECT_GT(newest().clearance, 0.0F);
        EXPECT_EQ(newest().flags, stays == 0 ? std::uint32_t{camera::cut} : 0U);
        send();
    }
    EXPECT_GE(stays, 44U) << "no shot is shorter than 2.2 s";
    EXPECT_NE(newest().flags & camera::cut, 0U);
}

TEST(Director, AnAutomaticTargetThatLeavesIsReplacedAtOnce) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", no_player));
    stage.send(Stage::poses(1));
    const std::uint32_t first = stage.publisher.frames().back().cameras.at(0).target;
    std::vector<std::uint32_t> others{1, 2, 3};
    std::erase(others, first);
    stage.send(Stage::poses(2, 1, others));
    const ShotCamera camera = stage.publisher.frames().back().cameras.at(0);
    EXPECT_NE(camera.target, first);
    EXPECT_NE(camera.flags & camera::cut, 0U);
    stage.send(Stage::poses(3, 1, {}));
    EXPECT_EQ(stage.publisher.frames().back().cameras.at(0).target, camera.target) << "it waits";
}

// The address sanitizer watches.
TEST(Director, RulesMayChangeAtAnyTime) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", no_player));
    std::uint32_t number = 1;
    for (; number < 42; ++number) {
        stage.director.receive("m", MatchEvent{1, Stage::poses(number).frame_time, 1, 1, 3, 0.0F});
        stage.send(Stage::poses(number));
    }
    config::Config config = Stage::default_config();
    config.direction.moments.clear();
    stage.director.reconfigure(config);
    ObserverRequest wanted = Stage::request("b", no_player);
    wanted.group = {2, 3};
    stage.ask(wanted);
    stage.send(Stage::poses(number));
    ASSERT_EQ(stage.publisher.frames().back().cameras.size(), 2U);
    const auto reasons = stage.publisher.frames().back().reasons;
    EXPECT_TRUE(
        std::ranges::all_of(reasons, [](const ShotReason& told) { return !told.reason.why.empty(); }));
}

TEST(Director, AnAutomaticTargetIsOfTheGroup) {
    Stage stage;
    stage.start();
    ObserverRequest wanted = Stage::request("a", no_player);
    wanted.group = {2, 3};
    stage.ask(wanted);
    for (std::uint32_t number = 1; number < 400; ++number) {
        if (number % 10 == 0)
            stage.director.receive("m", MatchEvent{1, Stage::poses(number).frame_time, 1, 1, 3, 0.0F});
        stage.send(Stage::poses(number));
        EXPECT_NE(stage.publisher.frames().back().cameras.at(0).target, 1U);
    }
}

TEST(Director, AnAutomaticTargetIsOfTheTeamWhoeverIsInIt) {
    Stage stage;
    MatchInfo info = Stage::info();
    info.players[1].team = 1;
    stage.start(info);
    ObserverRequest wanted = Stage::request("a", no_player);
    wanted.team = 2;
    stage.ask(wanted);
    stage.send(Stage::poses(1));
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::waiting_for_player);
    EXPECT_EQ(stage.publisher.status("a").reason, "nobody of team 2 plays");
    wanted.team = 1;
    stage.ask(wanted);
    const auto shows = [&](std::uint32_t begin, std::uint32_t end) {
        std::set<std::uint32_t> targets;
        for (std::uint32_t number = begin; number < end; ++number) {
            if (number % 10 == 0)
                stage.director.receive("m", MatchEvent{1, Stage::poses(number).frame_time, 1, 1, 3, 0.0F});
            stage.send(Stage::poses(number));
            targets.insert(stage.publisher.frames().back().cameras.at(0).target);
        }
        return targets;
    };
    EXPECT_THAT(shows(2, 400), testing::ElementsAre(2));
    EXPECT_EQ(stage.director.view(std::chrono::seconds(30)).matches.at(0).shots.at(0).team, 1);
    std::swap(info.players[1].team, info.players[2].team);
    stage.director.receive(info);
    EXPECT_THAT(shows(400, 800), testing::ElementsAre(3));
    // Nobody of the team is to be seen, but they are in the match.
    stage.send(Stage::poses(800, 1, {1, 3}));
    std::swap(info.players[1].team, info.players[2].team);
    stage.director.receive(info);
    stage.send(Stage::poses(801, 1, {1, 3}));
    EXPECT_EQ(stage.publisher.frames().back().cameras.at(0).target, no_player);
    stage.send(Stage::poses(802));
    EXPECT_EQ(stage.publisher.frames().back().cameras.at(0).target, 2U);
}

TEST(Director, EveryTeamHasItsAutomaticShot) {
    Stage stage;
    MatchInfo info = Stage::info();
    for (std::uint8_t i = 0; i < 3; ++i)
        info.players[i].team = i == 2 ? 2 : 1;
    stage.start(info);
    stage.send(Stage::poses(1));
    std::set<std::uint32_t> cameras;
    const auto ask = [&](const std::string& name, std::uint8_t team,
                         const std::vector<std::uint32_t>& group) {
        ObserverRequest wanted = Stage::request(name, no_player);
        wanted.team = team;
        wanted.group = group;
        stage.ask(wanted);
        cameras.insert(stage.publisher.status(name).camera_id);
    };
    ask("any", 0, {});
    ask("one", 1, {});
    ask("two", 2, {});
    ask("both", 1, {2, 3});
    EXPECT_EQ(cameras.size(), 4U);
    stage.send(Stage::poses(2));
    const auto target_of = [&](const std::string& name) {
        const CameraFrame frame = stage.publisher.frames().back();
        const std::uint32_t id = stage.publisher.status(name).camera_id;
        return std::ranges::find(frame.cameras, id, &ShotCamera::camera_id)->target;
    };
    EXPECT_LE(target_of("one"), 2U);
    EXPECT_EQ(target_of("two"), 3U);
    EXPECT_EQ(target_of("both"), 2U) << "of the group, and of the team";
}

// The undefined-behaviour sanitizer watches.
TEST(Director, AnyGameTimeIsProcessed) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", no_player));
    std::uint32_t number = 0;
    for (const std::int64_t time : {std::numeric_limits<std::int64_t>::min(),
                                    std::numeric_limits<std::int64_t>::max(), std::int64_t{0}}) {
        PoseFrame frame = Stage::poses(++number);
        frame.frame_time = time;
        stage.send(frame);
        stage.director.receive("m", MatchEvent{1, std::numeric_limits<std::int64_t>::max(), 1, 3, 2, 0.0F});
        stage.director.flush();
        EXPECT_EQ(stage.publisher.frames().size(), number);
    }
    EXPECT_EQ(stage.director.statistics()[Counter::events], 3U);
}

TEST(Director, LimitsAreEnforced) {
    config::Config config = Stage::default_config();
    config.limits.matches = 1;
    config.limits.observers = 3;
    config.limits.shots = 2;
    config.limits.players = 2;
    Stage stage(config);
    ASSERT_TRUE(stage.start());
    EXPECT_FALSE(stage.start(Stage::info("second")));
    EXPECT_TRUE(stage.start()) << "the match is known already";

    stage.ask(Stage::request("a", 1));
    stage.ask(Stage::request("b", 2));
    stage.ask(Stage::request("c", 3));
    EXPECT_EQ(stage.publisher.status("c").state, RequestState::refused);
    EXPECT_EQ(stage.publisher.status("c").reason, "this match has 2 cameras already");
    stage.ask(Stage::request("d", 2));
    EXPECT_EQ(stage.publisher.status("d").state, RequestState::refused);
    EXPECT_EQ(stage.publisher.status("d").reason, "3 observers watch this match already");
    stage.ask(Stage::request("e", 1));
    stage.ask(Stage::request("f", 2));
    stage.ask(Stage::request("g", 1));
    EXPECT_EQ(stage.publisher.status("g").reason, "3 observers watch this match already, and as many wait");

    stage.send(Stage::poses(1));
    EXPECT_EQ(stage.director.statistics()[Counter::drop_players], 1U);
    EXPECT_EQ(stage.director.statistics()[Counter::refused_matches], 1U);

    // The camera of an observer that leaves goes to one that was refused, and its place to the first that
    // waits.
    stage.director.request_ended("m", "a");
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("c").state, RequestState::accepted);
    EXPECT_EQ(stage.publisher.status("d").state, RequestState::accepted);
    EXPECT_EQ(stage.publisher.status("e").state, RequestState::refused);
    stage.director.request_ended("m", "e");
    stage.director.request_ended("m", "d");
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("f").state, RequestState::accepted);
    EXPECT_FALSE(stage.publisher.has_status("e"));
}

// Observers take no answer of another epoch than that of the match that they are shown.
TEST(Director, ObserversThatWaitAreRefusedAgainInTheNextEpoch) {
    config::Config config = Stage::default_config();
    config.limits.observers = 1;
    Stage stage(config);
    stage.start();
    stage.ask(Stage::request("a"));
    stage.ask(Stage::request("b"));
    ASSERT_EQ(stage.publisher.status("b").epoch, 1U);
    stage.start(Stage::info("m", 2));
    EXPECT_EQ(stage.publisher.status("b").epoch, 2U);
    EXPECT_EQ(stage.publisher.status("b").state, RequestState::refused);
    EXPECT_EQ(stage.publisher.status("b").reason, "1 observers watch this match already");
    const std::size_t published = stage.publisher.statuses_published();
    stage.ask(Stage::request("a", 2));
    EXPECT_EQ(stage.publisher.statuses_published(), published + 1) << "once in each epoch";
}

TEST(Director, HoweverManyAskTogetherAllAreAnswered) {
    constexpr std::size_t observers = 3 * Inbox::max_observers_taken;
    Stage stage;
    stage.start();
    for (std::size_t i = 0; i < observers; ++i)
        stage.director.receive(Stage::request(std::to_string(i)));
    stage.director.flush();
    for (std::size_t i = 0; i < observers; ++i)
        EXPECT_EQ(stage.publisher.status(std::to_string(i)).state, RequestState::accepted);
}

// Refuses the first status.
class ReluctantPublisher final : public MemoryPublisher {
  public:
    using MemoryPublisher::publish;
    bool publish(const ObserverStatus& status) override {
        return ++tried > 1 && MemoryPublisher::publish(status);
    }
    std::atomic<int> tried{0};
};

TEST(Director, TriesAgainToAnswerWithoutAnyMessage) {
    ReluctantPublisher publisher;
    MapLibrary maps;
    Director director(Stage::default_config(), maps, publisher);
    director.receive(Stage::request("a"));
    EXPECT_TRUE(eventually([&] { return publisher.has_status("a"); }));
    EXPECT_EQ(publisher.tried, 2);
}

TEST(Director, HasNoRoomWhereObserversWaitInAllPlaces) {
    config::Config config = Stage::default_config();
    config.limits.matches = 1;
    Stage stage(config);
    for (const char* match_id : {"a", "b"}) {
        EXPECT_TRUE(stage.director.has_room());
        ASSERT_TRUE(stage.start(Stage::info(match_id)));
        stage.ask(Stage::request("anna", 1, match_id));
        EXPECT_FALSE(stage.director.has_room());
        stage.director.match_ended(match_id);
        stage.director.flush();
    }
    EXPECT_FALSE(stage.director.has_room());
    EXPECT_FALSE(stage.start(Stage::info("c")));
}

TEST(Director, ObserversOfARefusedMatchAreRefused) {
    config::Config config = Stage::default_config();
    config.limits.matches = 1;
    Stage stage(config);
    stage.start();
    stage.ask(Stage::request("a", 1, "second"));
    EXPECT_EQ(stage.publisher.status("a", "second").state, RequestState::waiting_for_map);
    EXPECT_EQ(stage.publisher.status("a", "second").reason, "no game server runs this match");
    EXPECT_FALSE(stage.start(Stage::info("second")));
    EXPECT_EQ(stage.publisher.status("a", "second").state, RequestState::refused);
    EXPECT_EQ(stage.publisher.status("a", "second").reason, "1 matches run already");
    stage.ask(Stage::request("a", 1, "third"));
    EXPECT_EQ(stage.publisher.status("a", "third").state, RequestState::refused);

    stage.director.match_ended("m");
    EXPECT_TRUE(stage.start(Stage::info("second")));
    EXPECT_EQ(stage.publisher.status("a", "second").state, RequestState::accepted);
}

TEST(Director, AReloadedConfigurationIsAppliedToRunningRequests) {
    config::Config config = Stage::default_config();
    config.profiles["close"].distance = 40.0F;
    Stage stage(config);
    stage.start();
    ObserverRequest request = Stage::request("a");
    request.profile = "close";
    stage.ask(request);
    const std::uint32_t id = stage.publisher.status("a").camera_id;
    ASSERT_EQ(stage.publisher.status("a").state, RequestState::accepted);
    stage.send(Stage::poses(1));

    config.profiles["close"].distance = 30.0F;
    config.limits.shots = 1;  // limits change only with a restart
    stage.director.reconfigure(config);
    stage.ask(Stage::request("b"));
    EXPECT_EQ(stage.publisher.status("b").state, RequestState::accepted);
    EXPECT_EQ(stage.publisher.status("a").camera_id, id);
    stage.send(Stage::poses(2));
    const CameraFrame shown = stage.publisher.frames().back();
    for (const ShotCamera& camera : shown.cameras)
        EXPECT_EQ((camera.flags & camera::cut) != 0, camera.camera_id != id);

    config.profiles.erase("close");
    stage.director.reconfigure(config);
    stage.director.flush();
    EXPECT_EQ(stage.publisher.status("a").state, RequestState::refused);
}

TEST(Director, AViewShowsTheRunningMatches) {
    Stage stage;
    stage.start();
    stage.ask(Stage::request("a", 2));
    stage.ask(Stage::request("b", 77));
    stage.send(Stage::poses(5));
    const View view = stage.director.view(std::chrono::seconds(30));
    ASSERT_EQ(view.matches.size(), 1U);
    const MatchView& match = view.matches[0];
    EXPECT_TRUE(match.answered);
    EXPECT_EQ(match.match_id, "m");
    EXPECT_EQ(match.state, "running");
    EXPECT_EQ(match.map_name, "square");
    EXPECT_EQ(match.players.size(), 3U);
    EXPECT_EQ(match.last_pose_number, 5U);
    ASSERT_EQ(match.shots.size(), 1U);
    EXPECT_EQ(match.shots[0].target, 2U);
    ASSERT_EQ(match.observers.size(), 2U);
    EXPECT_EQ(match.observers[0].state, RequestState::accepted);
    EXPECT_EQ(match.observers[1].state, RequestState::waiting_for_player);
}

}  // namespace
}  // namespace camdir::director
