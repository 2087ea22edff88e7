// Processes that are killed or stopped, and how the others react.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <limits>
#include <memory>
#include <optional>
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
        observer.poll().value();
        const auto view = observer.newest_camera().value();
        return view && view->camera.target == target;
    });
}

TEST_F(FailureTest, AGameServerThatIsKilledAndStartedAgainIsANewEpoch) {
    Server server(domain_.id());
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context = Context::open(connection(domain_.id())).value();
    auto game = game_process();
    Observer observer = Observer::open(context, "game-0", "anna").value();
    observer.request({.target = 1}).value();
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

TEST_F(FailureTest, AStrangerCannotTakeAMatchThatRuns) {
    Server server(domain_.id());
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 3}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << server.log();
    {
        const Context elsewhere = Context::open(connection(domain_.id())).value();
        const Game stranger(elsewhere, "cup", "yard", 1, std::numeric_limits<std::uint64_t>::max());
        EXPECT_TRUE(sees(observer, [&](const auto& /*frame*/, auto /*cameras*/) {
            return server.log().find("PoseFrame of match 'cup' dropped: not_owner") != std::string::npos;
        })) << server.log();
        EXPECT_TRUE(serves_on(observer, 1, 120)) << server.log();
    }
    EXPECT_TRUE(serves_on(observer, 1, 120)) << server.log();
}

TEST_F(FailureTest, AGameServerWhoseClockWasSetBackBeginsTheMatchAnew) {
    Server server(domain_.id());
    const Context context = Context::open(connection(domain_.id())).value();
    const Context elsewhere = Context::open(connection(domain_.id())).value();
    std::optional<Game> game;
    game.emplace(context, "cup", "hall", 4, 2000);
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 3}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << server.log();
    const Game next(elsewhere, "cup", "yard", 4, 1000);
    EXPECT_TRUE(serves_on(observer, 1, 60)) << server.log();
    game.reset();
    EXPECT_TRUE(sees(observer, [](const auto& frame, auto cameras) {
        return frame.epoch == 1000 && has_target(cameras, 3);
    })) << server.log();
    EXPECT_TRUE(sees_own_camera(observer)) << server.log();
}

TEST_F(FailureTest, TheShotOfAnObserverThatIsKilledEnds) {
    Server server(domain_.id());
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "game-0", "hall");
    Observer stays = Observer::open(context, "game-0", "stays").value();
    stays.request({.target = 3}).value();
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
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 2}).value();
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
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 0}).value();
    auto server = std::make_unique<Server>(domain_.id(), Server::Options{.strength = 200});
    ASSERT_TRUE(shows(observer, 0)) << server->log();
    for (const std::uint32_t target : {1U, 2U, 3U}) {
        server->process().send_signal(SIGKILL);
        EXPECT_EQ(server->process().wait(), -SIGKILL);
        observer.request({.target = target}).value();
        server = std::make_unique<Server>(domain_.id());  // weaker than the first, then as strong
        EXPECT_TRUE(shows(observer, target)) << server->log();
    }
}

TEST_F(FailureTest, ADirectorThatWasStoppedGoesOn) {
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 2}).value();
    Server server(domain_.id());
    ASSERT_TRUE(sees_own_camera(observer)) << server.log();
    server.process().send_signal(SIGSTOP);
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_UNANSWERED));
    server.process().send_signal(SIGCONT);
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_ACCEPTED)) << server.log();
    EXPECT_TRUE(sees_own_camera(observer)) << server.log();
}

TEST_F(FailureTest, AGameServerClosesItsMatchThoughTheDirectorIsStopped) {
    constexpr std::chrono::milliseconds promised(300), of_a_busy_machine(300);
    Server server(domain_.id());
    const Context context = Context::open(connection(domain_.id())).value();
    std::optional<Game> game;
    game.emplace(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 2}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << server.log();
    server.process().send_signal(SIGSTOP);
    const auto begun = std::chrono::steady_clock::now();
    game.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begun, promised + of_a_busy_machine);
    server.process().send_signal(SIGCONT);
}

// The game server's description lives for 2 s without a sign of its writer, its participant for 10 s.
TEST_F(FailureTest, AStopDoesNotEndTheMatch) {
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 2}).value();
    Server server(domain_.id());
    for (const int seconds : {3, 4, 5}) {
        ASSERT_TRUE(sees_own_camera(observer)) << server.log();
        server.process().send_signal(SIGSTOP);
        std::this_thread::sleep_for(std::chrono::seconds(seconds));
        observer.poll().value();
        server.process().send_signal(SIGCONT);
        EXPECT_TRUE(comes_to(observer, CDIR_SHOT_ACCEPTED)) << server.log();
    }
    EXPECT_TRUE(sees_own_camera(observer)) << server.log();
    EXPECT_THAT(server.log(), testing::Not(testing::HasSubstr("ended")));
}

TEST_F(FailureTest, ADirectorThatWasStoppedAnswersAgainWithoutCameras) {
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "cellar");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 2}).value();
    Server server(domain_.id());
    ASSERT_TRUE(comes_to(observer, CDIR_SHOT_WAITING_FOR_MAP)) << server.log();
    server.process().send_signal(SIGSTOP);
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_UNANSWERED));
    server.process().send_signal(SIGCONT);
    EXPECT_TRUE(comes_to(observer, CDIR_SHOT_WAITING_FOR_MAP)) << server.log();
}

// Starts a standby, director 20, of the match that director 10 serves, until it is known and follows.
class StandbyOf {
  public:
    StandbyOf(std::uint32_t domain, Observer& observer)
        : server_(domain, {.participant_index = 1, .strength = 100, .director_id = 20}) {
        EXPECT_TRUE(server_.ready()) << log();
        EXPECT_TRUE(eventually([&] {
            observer.poll().value();
            return observer.counters().value().directors == 2;
        })) << log();
        EXPECT_TRUE(serves_on(observer, 10, 60)) << log();
    }
    Server& server() { return server_; }
    [[nodiscard]] std::string log() const { return server_.log(); }

  private:
    Server server_;
};

TEST_F(FailureTest, TheStandbyTakesOverWithTheSameCameraIds) {
    Server leader(domain_.id(), {.strength = 200, .director_id = 10});
    ASSERT_TRUE(leader.ready()) << leader.log();
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "hall");
    Observer first = Observer::open(context, "cup", "first").value();
    Observer second = Observer::open(context, "cup", "second").value();
    first.request({.target = 2}).value();
    second.request({.target = 1}).value();
    ASSERT_TRUE(sees(first, [](const auto& frame, auto cameras) {
        return frame.director_id == 10 && cameras.size() == 2;
    })) << leader.log();
    ASSERT_TRUE(comes_to(first, CDIR_SHOT_ACCEPTED));
    const StandbyOf standby(domain_.id(), first);
    const std::uint32_t camera_id = first.shot_status().value().camera_id;

    const std::uint64_t hand_overs = first.counters().value().hand_overs;
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
    EXPECT_EQ(first.counters().value().hand_overs, hand_overs + 1);
    first.request({.target = 3}).value();
    EXPECT_TRUE(shows(first, 3)) << standby.log();
}

// Also to who asks for no shot.
TEST_F(FailureTest, AMapThatChangesAsTheLeaderDiesIsShownByTheStandby) {
    Server leader(domain_.id(), {.strength = 200, .director_id = 10});
    ASSERT_TRUE(leader.ready()) << leader.log();
    const Context context = Context::open(connection(domain_.id())).value();
    Game game(context, "cup", "hall");
    Observer asks = Observer::open(context, "cup", "asks").value();
    Observer only_looks = Observer::open(context, "cup", "only looks").value();
    asks.request({.target = 2}).value();
    for (Observer* observer : {&asks, &only_looks}) {
        ASSERT_TRUE(sees(*observer, [&](const auto& frame, auto cameras) {
            const auto info = observer->match_info().value();
            return frame.director_id == 10 && has_target(cameras, 2) && info && info->map_name == "hall";
        })) << leader.log();
    }
    const StandbyOf standby(domain_.id(), asks);
    leader.process().send_signal(SIGKILL);
    game.change_map("yard");
    for (Observer* observer : {&asks, &only_looks}) {
        EXPECT_TRUE(sees(*observer, [&](const auto& frame, auto cameras) {
            const auto info = observer->match_info().value();
            return frame.director_id == 20 && has_target(cameras, 2) && info && info->map_name == "yard";
        })) << standby.log();
    }
}

TEST_F(FailureTest, ALeaderThatIsStoppedHandsOver) {
    Server leader(domain_.id(), {.strength = 200, .director_id = 10});
    ASSERT_TRUE(leader.ready()) << leader.log();
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 2}).value();
    ASSERT_TRUE(sees(observer, [](const auto& frame, auto cameras) {
        return frame.director_id == 10 && has_target(cameras, 2);
    }));
    const StandbyOf standby(domain_.id(), observer);
    leader.process().send_signal(SIGTERM);
    EXPECT_EQ(leader.process().wait_for(patience), 0) << leader.log();
    EXPECT_TRUE(sees(observer, [](const auto& frame, auto cameras) {
        return frame.director_id == 20 && has_target(cameras, 2);
    })) << standby.log();
    EXPECT_TRUE(sees_own_camera(observer));
}

// A leader (director 10) and a standby (director 20) of the match "cup", whose player 2 an observer sees.
class HandOverTest : public FailureTest {
  protected:
    void SetUp() override {
        leader_ = start_leader();
        ASSERT_TRUE(leader_->ready()) << leader_->log();
        game_.emplace(context_, "cup", "hall");
        observer_ = Observer::open(context_, "cup", "anna").value();
        observer_->request({.target = 2}).value();
        ASSERT_TRUE(sees_own_camera(*observer_)) << leader_->log();
        standby_.emplace(domain_.id(), *observer_);
    }
    std::unique_ptr<Server> start_leader() {
        return std::make_unique<Server>(
            domain_.id(), Server::Options{.strength = 200, .director_id = 10, .has_yard = false});
    }
    bool sees_directors(std::uint32_t count) {
        return eventually([&] {
            observer_->poll().value();
            return observer_->counters().value().directors == count;
        });
    }
    bool is_served_by(std::uint64_t director_id) {
        return sees(*observer_, [&](const auto& frame, auto cameras) {
            return frame.director_id == director_id && has_target(cameras, 2);
        });
    }

    Context context_ = Context::open(connection(domain_.id())).value();
    std::unique_ptr<Server> leader_;
    std::optional<Game> game_;
    std::optional<Observer> observer_;
    std::optional<StandbyOf> standby_;
};

TEST_F(HandOverTest, ALeaderThatIsKilledAndStartedAgainStandsBy) {
    leader_->process().send_signal(SIGKILL);
    leader_->process().wait();
    ASSERT_TRUE(is_served_by(20)) << standby_->log();
    leader_ = start_leader();
    ASSERT_TRUE(leader_->ready()) << leader_->log();
    ASSERT_TRUE(sees_directors(2)) << leader_->log();
    EXPECT_TRUE(serves_on(*observer_, 20, 180)) << leader_->log();
    standby_->server().process().send_signal(SIGKILL);
    EXPECT_TRUE(is_served_by(10)) << leader_->log();
    EXPECT_TRUE(serves_on(*observer_, 10, 60)) << leader_->log();
}

TEST_F(HandOverTest, ALeaderThatWasPausedStandsBy) {
    leader_->process().send_signal(SIGSTOP);
    ASSERT_TRUE(is_served_by(20)) << standby_->log();
    leader_->process().send_signal(SIGCONT);
    EXPECT_TRUE(serves_on(*observer_, 20, 180)) << leader_->log();
    EXPECT_TRUE(eventually([&] {
        return leader_->log().find("this director stands by") != std::string::npos;
    })) << leader_->log();
    standby_->server().process().send_signal(SIGKILL);
    EXPECT_TRUE(is_served_by(10)) << leader_->log();
    EXPECT_TRUE(serves_on(*observer_, 10, 60)) << leader_->log();
}

TEST_F(HandOverTest, TheShotGoesOnWithoutACutWhenTheLeaderIsStopped) {
    std::uint32_t last = 0;
    ASSERT_TRUE(serves_on(*observer_, 10, 60));  // the standby follows
    ASSERT_TRUE(sees(*observer_, [&](const auto& frame, auto /*cameras*/) {
        last = frame.frame_number;
        return true;
    }));
    const std::uint32_t segment = observer_->newest_camera().value()->segment;
    const std::uint64_t gaps = observer_->counters().value().gaps;
    bool is_late = false;
    leader_->process().send_signal(SIGTERM);
    EXPECT_TRUE(sees(*observer_, [&](const auto& frame, auto /*cameras*/) {
        is_late = is_late || came_late(frame);
        EXPECT_TRUE(frame.frame_number == last + 1 || came_late(frame));
        last = frame.frame_number;
        return frame.director_id == 20;
    })) << standby_->log();
    if (is_late && observer_->counters().value().gaps != gaps) return;  // this process was too slow
    EXPECT_EQ(observer_->newest_camera().value()->segment, segment);
    EXPECT_EQ(observer_->counters().value().gaps, gaps);
}

TEST_F(HandOverTest, AStandbyThatWasPausedOrKilledIsNotNoticed) {
    standby_->server().process().send_signal(SIGSTOP);
    EXPECT_TRUE(serves_on(*observer_, 10, 180)) << leader_->log();
    standby_->server().process().send_signal(SIGCONT);
    EXPECT_TRUE(serves_on(*observer_, 10, 180)) << standby_->log();
    standby_->server().process().send_signal(SIGKILL);
    EXPECT_TRUE(serves_on(*observer_, 10, 180)) << leader_->log();
}

TEST_F(HandOverTest, AMapThatTheLeaderLacksIsServedByTheStandby) {
    game_->change_map("yard");
    EXPECT_TRUE(is_served_by(20)) << leader_->log() << standby_->log();
    EXPECT_TRUE(serves_on(*observer_, 20, 60)) << leader_->log();
}

}  // namespace
}  // namespace camdir::test
