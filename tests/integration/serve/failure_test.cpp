// Processes that are killed or stopped, and how the others react.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <thread>

#include "hall.hpp"
#include "support/eventually.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using camera_director::Context;
using camera_director::Observer;

class FailureTest : public testing::Test {
  protected:
    // A game server as a child process: match "game-0", 4 players.
    std::unique_ptr<ChildProcess> game_process() {
        return std::make_unique<ChildProcess>(std::vector<std::string>{
            CAMDIR_BIN_DIR "/synthetic-players", (folder_ / "hall.vfs").string(), "--domain",
            std::to_string(domain_.id()), "--match-prefix", "game", "--players", "4"});
    }
    void SetUp() override { write_hall(folder_ / "hall.vfs"); }

    TestDomain domain_;
    TemporaryFolder folder_;
};

bool has_target(std::span<const camera_director::Camera> cameras, std::uint32_t target) {
    return std::any_of(cameras.begin(), cameras.end(),
                       [&](const auto& camera) { return camera.target == target; });
}

// The observer's own shot comes to show this player.
bool shows(Observer& observer, std::uint32_t target) {
    return eventually([&] {
        observer.poll();
        const auto view = observer.newest_camera();
        return view && view->camera.target == target;
    });
}

TEST_F(FailureTest, AGameServerThatIsKilledAndStartedAgainIsANewEpoch) {
    Server server(domain_.id());
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context(connection(domain_.id()));
    auto game = game_process();
    Observer observer(context, "game-0", "anna");
    observer.request({.target = 1});
    ASSERT_TRUE(sees_own_camera(observer)) << server.log();
    std::uint64_t before = 0;
    ASSERT_TRUE(sees(observer, [&](const auto& frame, auto /*cameras*/) {
        before = frame.epoch;
        return true;
    }));

    game->send_signal(SIGKILL);
    EXPECT_EQ(game->wait(), -SIGKILL);
    game = game_process();
    EXPECT_TRUE(sees(observer, [&](const auto& frame, auto cameras) {
        return frame.epoch > before && has_target(cameras, 1);
    })) << server.log();
}

TEST_F(FailureTest, TheShotOfAnObserverThatIsKilledEnds) {
    Server server(domain_.id());
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context(connection(domain_.id()));
    const Game game(context, "game-0", "hall");
    Observer stays(context, "game-0", "stays");
    stays.request({.target = 3});
    ChildProcess dies({CAMDIR_BIN_DIR "/observer-probe", "--domain", std::to_string(domain_.id()),
                       "--match-prefix", "game"});  // asks for player 0
    ASSERT_TRUE(sees(stays, [](const auto& /*frame*/, auto cameras) {
        return has_target(cameras, 0) && has_target(cameras, 3);
    })) << server.log();
    dies.send_signal(SIGKILL);
    EXPECT_TRUE(sees(stays, [](const auto& /*frame*/,
                               auto cameras) { return !has_target(cameras, 0) && has_target(cameras, 3); }))
        << "its request's liveliness lasts 10 s\n"
        << server.log();
}

TEST_F(FailureTest, AServerThatIsKilledAndStartedAgainFindsItsMatches) {
    const Context context(connection(domain_.id()));
    const Game game(context, "cup", "hall");
    Observer observer(context, "cup", "anna");
    observer.request({.target = 2});
    auto server = std::make_unique<Server>(domain_.id(), Server::Options{.director_id = 10});
    ASSERT_TRUE(sees_own_camera(observer)) << server->log();
    server->process().send_signal(SIGKILL);
    EXPECT_EQ(server->process().wait(), -SIGKILL);
    server = std::make_unique<Server>(domain_.id(), Server::Options{.director_id = 11});
    EXPECT_TRUE(sees(observer, [](const auto& frame, auto cameras) {
        return frame.director_id == 11 && has_target(cameras, 2);
    })) << server->log();
}

// The observer's reader takes the dead director for the owner of the answer until its lease ends.
TEST_F(FailureTest, AShotThatIsChangedWhileTheDirectorIsDeadIsShownByTheNextOne) {
    const Context context(connection(domain_.id()));
    const Game game(context, "cup", "hall");
    Observer observer(context, "cup", "anna");
    observer.request({.target = 0});
    auto server = std::make_unique<Server>(domain_.id(), Server::Options{.strength = 200});
    ASSERT_TRUE(shows(observer, 0)) << server->log();
    for (const std::uint32_t target : {1U, 2U, 3U}) {
        server->process().send_signal(SIGKILL);
        EXPECT_EQ(server->process().wait(), -SIGKILL);
        observer.request({.target = target});
        server = std::make_unique<Server>(domain_.id());  // weaker than the first, then as strong
        EXPECT_TRUE(shows(observer, target)) << server->log();
    }
}

TEST_F(FailureTest, ADirectorThatWasStoppedGoesOn) {
    const Context context(connection(domain_.id()));
    const Game game(context, "cup", "hall");
    Observer observer(context, "cup", "anna");
    observer.request({.target = 2});
    Server server(domain_.id());
    ASSERT_TRUE(sees_own_camera(observer)) << server.log();
    server.process().send_signal(SIGSTOP);
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_UNANSWERED));
    server.process().send_signal(SIGCONT);
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_ACCEPTED)) << server.log();
    EXPECT_TRUE(sees_own_camera(observer)) << server.log();
}

// The game server's description lives for 2 s without a sign of its writer, its participant for 10 s.
TEST_F(FailureTest, AStopDoesNotEndTheMatch) {
    const Context context(connection(domain_.id()));
    const Game game(context, "cup", "hall");
    Observer observer(context, "cup", "anna");
    observer.request({.target = 2});
    Server server(domain_.id());
    for (const int seconds : {3, 4, 5}) {
        ASSERT_TRUE(sees_own_camera(observer)) << server.log();
        server.process().send_signal(SIGSTOP);
        std::this_thread::sleep_for(std::chrono::seconds(seconds));
        observer.poll();
        server.process().send_signal(SIGCONT);
        EXPECT_TRUE(comes_to(observer, CDIR_SHOT_ACCEPTED)) << server.log();
    }
    EXPECT_TRUE(sees_own_camera(observer)) << server.log();
    EXPECT_THAT(server.log(), testing::Not(testing::HasSubstr("ended")));
}

TEST_F(FailureTest, ADirectorThatWasStoppedAnswersAgainWithoutCameras) {
    const Context context(connection(domain_.id()));
    const Game game(context, "cup", "cellar");
    Observer observer(context, "cup", "anna");
    observer.request({.target = 2});
    Server server(domain_.id());
    ASSERT_TRUE(comes_to(observer, CDIR_SHOT_WAITING_FOR_MAP)) << server.log();
    server.process().send_signal(SIGSTOP);
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_UNANSWERED));
    server.process().send_signal(SIGCONT);
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_WAITING_FOR_MAP)) << server.log();
}

TEST_F(FailureTest, TheStandbyTakesOverWithTheSameCameraIds) {
    Server leader(domain_.id(), {.participant_index = 0, .strength = 200, .director_id = 10});
    Server standby(domain_.id(), {.participant_index = 1, .strength = 100, .director_id = 20});
    ASSERT_TRUE(leader.ready() && standby.ready()) << leader.log() << standby.log();
    const Context context(connection(domain_.id()));
    const Game game(context, "cup", "hall");
    Observer first(context, "cup", "first");
    Observer second(context, "cup", "second");
    first.request({.target = 2});
    second.request({.target = 1});
    ASSERT_TRUE(eventually([&] {
        first.poll();
        return first.counters().directors == 2;
    })) << standby.log();
    ASSERT_TRUE(sees(first, [](const auto& frame, auto cameras) {
        return frame.director_id == 10 && cameras.size() == 2;
    })) << leader.log();
    ASSERT_TRUE(comes_to(first, CDIR_SHOT_ACCEPTED));
    const std::uint32_t camera_id = first.shot_status().camera_id;

    // The standby may have been received before the leader was found.
    const std::uint64_t hand_overs = first.counters().hand_overs;
    leader.process().send_signal(SIGKILL);
    EXPECT_TRUE(sees(first, [&](const auto& frame, auto cameras) {
        if (frame.director_id != 20 || !has_target(cameras, 2)) return false;
        for (const auto& camera : cameras) {
            if (camera.target == 2) {
                EXPECT_EQ(camera.camera_id, camera_id);
            }
        }
        return true;
    })) << standby.log();
    EXPECT_EQ(first.counters().hand_overs, hand_overs + 1);
    first.request({.target = 3});
    EXPECT_TRUE(shows(first, 3)) << standby.log();
}

// The observer's reader drops what the standby writes of the match until the leader's lease ends.
TEST_F(FailureTest, AMapThatChangesAsTheLeaderDiesIsShownByTheStandby) {
    Server leader(domain_.id(), {.participant_index = 0, .strength = 200, .director_id = 10});
    Server standby(domain_.id(), {.participant_index = 1, .strength = 100, .director_id = 20});
    ASSERT_TRUE(leader.ready() && standby.ready()) << leader.log() << standby.log();
    const Context context(connection(domain_.id()));
    Game game(context, "cup", "hall");
    Observer asks(context, "cup", "asks");
    Observer only_looks(context, "cup", "only looks");
    asks.request({.target = 2});
    for (Observer* observer : {&asks, &only_looks}) {
        ASSERT_TRUE(sees(*observer, [&](const auto& frame, auto cameras) {
            const auto info = observer->match_info();
            return frame.director_id == 10 && has_target(cameras, 2) && observer->counters().directors == 2 &&
                   info && info->map_name == "hall";
        })) << leader.log();
    }
    leader.process().send_signal(SIGKILL);
    game.change_map("yard");
    for (Observer* observer : {&asks, &only_looks}) {
        EXPECT_TRUE(sees(*observer, [&](const auto& frame, auto cameras) {
            const auto info = observer->match_info();
            return frame.director_id == 20 && has_target(cameras, 2) && info && info->map_name == "yard";
        })) << standby.log();
    }
}

TEST_F(FailureTest, ALeaderThatIsStoppedHandsOver) {
    Server leader(domain_.id(), {.participant_index = 0, .strength = 200, .director_id = 10});
    Server standby(domain_.id(), {.participant_index = 1, .strength = 100, .director_id = 20});
    ASSERT_TRUE(leader.ready() && standby.ready()) << leader.log() << standby.log();
    const Context context(connection(domain_.id()));
    const Game game(context, "cup", "hall");
    Observer observer(context, "cup", "anna");
    observer.request({.target = 2});
    ASSERT_TRUE(eventually([&] {
        observer.poll();
        return observer.counters().directors == 2;
    }));
    ASSERT_TRUE(sees(observer, [](const auto& frame, auto cameras) {
        return frame.director_id == 10 && has_target(cameras, 2);
    }));
    leader.process().send_signal(SIGTERM);
    EXPECT_EQ(leader.process().wait_for(patience), 0) << leader.log();
    EXPECT_TRUE(sees(observer, [](const auto& frame, auto cameras) {
        return frame.director_id == 20 && has_target(cameras, 2);
    })) << standby.log();
    EXPECT_TRUE(sees_own_camera(observer));
}

}  // namespace
}  // namespace camdir::test
