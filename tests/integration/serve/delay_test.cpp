// Matches that are shown with a delay, by real processes over real DDS. What must not be early is judged by
// the times in the data.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <memory>

#include "hall.hpp"
#include "support/eventually.hpp"
#include "support/raw_peer.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using camera_director::Context;
using camera_director::Observer;
using testing::HasSubstr;

constexpr std::int64_t delay = 2'000'000'000;

// CLOCK_REALTIME in ns.
std::int64_t real_time() {
    return std::chrono::system_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

template <class Frame>
void expect_not_early(const Frame& frame) {
    EXPECT_GE(real_time() - frame.source_time, delay);
    EXPECT_GE(frame.write_time - frame.source_time, delay);
}

class DelayTest : public testing::Test {
  protected:
    // A game server as a child process: match "game-0", 4 players.
    std::unique_ptr<ChildProcess> game_process(const std::string& delay_s) {
        return std::make_unique<ChildProcess>(std::vector<std::string>{
            CAMDIR_BIN_DIR "/synthetic-players", (folder_ / "hall.vfs").string(), "--domain",
            std::to_string(domain_.id()), "--match-prefix", "game", "--players", "4", "--delay", delay_s});
    }
    void SetUp() override { write_hall(folder_ / "hall.vfs"); }

    TestDomain domain_;
    TemporaryFolder folder_;
};

TEST_F(DelayTest, NothingIsEarlyAndAKilledGameServerIsShownToItsEnd) {
    Server server(domain_.id(), Server::Options{.minimum_delay_s = 1.0});
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context = Context::open(connection(domain_.id())).value();
    Observer observer = Observer::open(context, "game-0", "anna").value();
    observer.request({.target = 1}).value();
    const auto game = game_process("2");
    ASSERT_TRUE(comes_to(observer, CDIR_SHOT_WAITING_FOR_MAP)) << server.log();
    EXPECT_THAT(observer.shot_status().value().reason,
                HasSubstr("shown with a delay of 2 s: the cameras begin at 2"));

    int frames = 0;
    ASSERT_TRUE(sees(observer, [&](const auto& frame, auto cameras) {
        expect_not_early(frame);
        frames += cameras.size() == 1 ? 1 : 0;
        return frames == 120;
    })) << server.log();

    // An observer that joins now need not wait.
    Observer late = Observer::open(context, "game-0", "late").value();
    late.request({.target = 2}).value();
    ASSERT_TRUE(eventually([&] {
        late.poll().value();
        const std::uint32_t state = late.shot_status().value().state;
        EXPECT_NE(state, std::uint32_t{CDIR_SHOT_WAITING_FOR_MAP});
        return state == CDIR_SHOT_ACCEPTED;
    }));
    EXPECT_TRUE(sees_own_camera(late));

    game->send_signal(SIGKILL);
    EXPECT_EQ(game->wait(), -SIGKILL);
    const std::int64_t killed = real_time();
    int shown_after = 0;
    EXPECT_TRUE(sees(observer, [&](const auto& frame, auto cameras) {
        expect_not_early(frame);
        EXPECT_LE(frame.source_time, killed);
        if (frame.write_time > killed) {
            ++shown_after;
            EXPECT_EQ(cameras.size(), 2U);
        }
        return frame.write_time >= killed + delay - 500'000'000;
    })) << server.log();
    EXPECT_GE(shown_after, 5) << "of about 90";
}

TEST_F(DelayTest, AMapChangeIsShownWithTheDelayToo) {
    Server server(domain_.id(), Server::Options{.minimum_delay_s = 2.0});
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context = Context::open(connection(domain_.id())).value();
    RawPeer observer(domain_.id(), "cup");
    Game game(context, "cup", "hall");
    observer.write(raw_request("cup", "anna", 0));
    std::uint64_t first_epoch = 0;
    std::uint64_t second_epoch = 0;
    std::int64_t changed = 0;
    int old_ones = 0;  // of the first epoch, after its end
    EXPECT_TRUE(eventually([&] {
        for (const RawPeer::CameraFrame& frame : observer.take_cameras()) {
            expect_not_early(frame);
            if (first_epoch == 0) first_epoch = frame.epoch;
            if (frame.epoch > first_epoch) second_epoch = frame.epoch;
            if (changed != 0 && frame.epoch == first_epoch && frame.write_time > changed) ++old_ones;
        }
        if (first_epoch != 0 && changed == 0) {
            game.change_map("yard");
            changed = real_time();
        }
        return second_epoch != 0;
    })) << server.log();
    EXPECT_GE(old_ones, 5) << "of about 120";
    EXPECT_TRUE(eventually([&] {
        const auto& statuses = observer.statuses();
        const auto found = statuses.find("anna");
        return found != statuses.end() && found->second.epoch == second_epoch;
    })) << server.log();
}

TEST_F(DelayTest, AnObserverKnowsOfTheNextMapWhenTheOneBeforeIsShownToItsEnd) {
    Server server(domain_.id(), Server::Options{.minimum_delay_s = 2.0});
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context = Context::open(connection(domain_.id())).value();
    Game game(context, "cup", "hall", 4);
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 0}).value();
    std::uint64_t first_epoch = 0;
    std::int64_t changed = 0;
    int old_ones = 0;  // of the first epoch, after its end
    EXPECT_TRUE(sees(observer, [&](const auto& frame, auto cameras) {
        expect_not_early(frame);
        if (first_epoch == 0) first_epoch = frame.epoch;
        const bool first = frame.epoch == first_epoch;
        const auto info = observer.match_info().value();
        EXPECT_TRUE(info);
        if (!info) return true;
        EXPECT_EQ(info->epoch, frame.epoch);
        EXPECT_EQ(info->map_name, first ? "hall" : "yard");
        EXPECT_EQ(info->players.size(), first ? 4U : 2U);
        if (changed == 0) {
            game.change_map("yard", 2);
            changed = real_time();
        }
        if (first && frame.source_time < changed && frame.write_time > changed) {
            old_ones += cameras.size() == 1 ? 1 : 0;
            EXPECT_EQ(observer.shot_status().value().state, std::uint32_t{CDIR_SHOT_ACCEPTED});
        }
        return !first && cameras.size() == 1;
    })) << server.log();
    EXPECT_GE(old_ones, 5) << "of about 120";
    EXPECT_TRUE(sees_own_camera(observer)) << server.log();
}

TEST_F(DelayTest, ADirectorThatStartsLeavesTheMatchToTheOneWhoseDelayIsFull) {
    Server first(domain_.id(), {.participant_index = 1, .director_id = 20, .minimum_delay_s = 2.0});
    ASSERT_TRUE(first.ready()) << first.log();
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 1}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << first.log();
    Server second(domain_.id(), {.strength = 200, .director_id = 10, .minimum_delay_s = 2.0});
    ASSERT_TRUE(second.ready()) << second.log();
    EXPECT_TRUE(serves_on(observer, 20, 300)) << second.log();
    first.process().send_signal(SIGKILL);
    EXPECT_TRUE(sees(observer, [&](const auto& frame, auto cameras) {
        return frame.director_id == 10 && cameras.size() == 1;
    })) << second.log();
}

TEST_F(DelayTest, ADelayThatIsTooLongIsRefused) {
    Server server(domain_.id());
    ASSERT_TRUE(server.ready()) << server.log();
    const Context context = Context::open(connection(domain_.id())).value();
    const auto game = game_process("150");
    Observer observer = Observer::open(context, "game-0", "anna").value();
    observer.request({.target = 1}).value();
    ASSERT_TRUE(comes_to(observer, CDIR_SHOT_REFUSED)) << server.log();
    EXPECT_STREQ(observer.shot_status().value().reason,
                 "a delay of 150 s is wanted; the longest possible is 120 s");
    EXPECT_THAT(server.log(), HasSubstr("match game-0: refused: a delay of 150 s is wanted"));
    EXPECT_EQ(observer.counters().value().frames, 0U);
}

}  // namespace
}  // namespace camdir::test
