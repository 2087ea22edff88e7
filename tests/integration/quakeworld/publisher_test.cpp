// qtv-publisher between a QTV server and a director that the test plays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <camera_director/camera_director.h>
#include <csignal>
#include <fstream>

#include "directors_domain.hpp"
#include "fake_director.hpp"
#include "qtv_server.hpp"
#include "support/child_process.hpp"
#include "support/demo_writer.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string program = std::string(CAMDIR_BIN_DIR) + "/qtv-publisher";
const std::string begin = "QTVSV 1\nBEGIN\n\n";

DemoWriter level(const std::string& map) {
    return DemoWriter().to_everyone(0, DemoMessages()
                                           .begin_level()
                                           .client_command("fullserverinfo \"\\teamplay\\2\"\n")
                                           .models({"maps/" + map + ".bsp", "progs/player.mdl"})
                                           .user_info(2, R"(\name\anna\team\red)")
                                           .user_info(5, R"(\name\bert\team\blue)"));
}

// A frame in which anna is at x and bert is dead or not.
DemoMessages frame(double x, bool dead) {
    return DemoMessages()
        .player(2, {.origin = Vec3d(x, 16, 24), .angles = Vec3d(0, 90, 0), .model = 2})
        .player(5, {.origin = Vec3d(100, 0, 24), .model = 2, .dead = dead});
}

class QtvPublisher : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(domain_.joined()) << "every domain is taken";
        director_.emplace(domain_.number(), "cup");
    }

    void start(const std::vector<std::string>& options = {}) {
        std::vector<std::string> command = {program,    "127.0.0.1:" + std::to_string(server_.port()),
                                            "--domain", domain_.text(),
                                            "--match",  "cup"};
        command.insert(command.end(), options.begin(), options.end());
        publisher_.emplace(command);
    }
    [[nodiscard]] ReceivedInfo next_info() {
        std::optional<ReceivedInfo> info;
        EXPECT_TRUE(eventually([&] { return (info = director_->take_info()).has_value(); })) << log();
        return info.value_or(ReceivedInfo{});
    }
    [[nodiscard]] camera_director_MatchEvent next_event() {
        std::optional<camera_director_MatchEvent> event;
        EXPECT_TRUE(eventually([&] { return (event = director_->take_event()).has_value(); })) << log();
        return event.value_or(camera_director_MatchEvent{});
    }
    // Streams `frame` over and over, 40 ms of the game apart, until one of its poses arrives.
    [[nodiscard]] ReceivedPoses streams(const DemoMessages& content) {
        std::optional<ReceivedPoses> poses;
        EXPECT_TRUE(eventually([&] {
            server_.send(DemoWriter().to_everyone(40, content).bytes());
            return (poses = director_->take_poses()).has_value();
        })) << log();
        return poses.value_or(ReceivedPoses{});
    }
    [[nodiscard]] std::string log() const { return publisher_->errors(); }

    DirectorsDomain domain_;
    std::optional<FakeDirector> director_;
    QtvServer server_;
    std::optional<ChildProcess> publisher_;
};

TEST_F(QtvPublisher, PublishesPosesNamesTeamsAndEvents) {
    start();
    EXPECT_EQ(server_.accept(), "QTV\nVERSION: 1\n\n");
    server_.send(begin);
    server_.send(level("dm3").bytes());
    const ReceivedInfo info = next_info();
    EXPECT_EQ(info.map_name, "dm3");
    EXPECT_THAT(info.player_id, ElementsAre(2, 5));
    EXPECT_THAT(info.player_name, ElementsAre("anna", "bert"));
    EXPECT_THAT(info.player_team, ElementsAre(1, 2));

    const ReceivedPoses poses = streams(frame(8, false));
    EXPECT_EQ(poses.epoch, info.epoch);
    EXPECT_EQ(poses.frame_time % 40'000'000, 0) << "the demo's clock";
    EXPECT_THAT(poses.player_id, ElementsAre(2, 5));
    EXPECT_THAT(poses.flags, ElementsAre(testing::Ne(0), testing::Ne(0)));
    EXPECT_THAT(std::vector(poses.eye.begin(), poses.eye.begin() + 3), ElementsAre(8.0F, 16.0F, 46.0F));
    EXPECT_NEAR(poses.orientation[2], std::sqrt(0.5F), 1e-6F);

    ASSERT_TRUE(eventually([&] {
        (void)streams(frame(8, true));
        (void)streams(frame(8, false));
        const auto event = director_->take_event();
        return event && event->kind == CDIR_EVENT_SPAWN;
    })) << log();
    server_.send(DemoWriter().to_everyone(0, DemoMessages().print(1, "bert rides anna's rocket\n")).bytes());
    (void)streams(frame(8, true));
    for (int i = 0; i < 4; ++i)
        (void)streams(frame(8, true));
    camera_director_MatchEvent event = next_event();
    while (event.kind == CDIR_EVENT_SPAWN)
        event = next_event();
    EXPECT_EQ(event.kind, CDIR_EVENT_KILL);
    EXPECT_EQ(event.actor, 2U);
    EXPECT_EQ(event.subject, 5U);
    EXPECT_STREQ(event.detail, "rl");
}

TEST_F(QtvPublisher, AMapChangeBeginsAnEpoch) {
    start();
    ASSERT_TRUE(server_.accept());
    server_.send(begin);
    server_.send(level("dm3").bytes());
    const ReceivedInfo first = next_info();
    (void)streams(frame(8, false));
    server_.send(level("e1m2").bytes());
    const ReceivedInfo second = next_info();
    EXPECT_EQ(second.map_name, "e1m2");
    EXPECT_GT(second.epoch, first.epoch);
    EXPECT_TRUE(eventually([&] { return streams(frame(8, false)).epoch == second.epoch; })) << log();
}

TEST_F(QtvPublisher, ConnectsAgainAndBeginsAnEpoch) {
    start();
    ASSERT_TRUE(server_.accept());
    server_.send(begin);
    server_.send(level("dm3").bytes());
    const ReceivedInfo first = next_info();
    server_.close();
    ASSERT_TRUE(server_.accept()) << log();
    EXPECT_THAT(log(), HasSubstr("the server has closed the connection; connecting again in 1 s"));
    server_.send(begin);
    server_.send(level("dm3").bytes());
    EXPECT_GT(next_info().epoch, first.epoch);
    // What no server sends: told, and the connection is another one.
    server_.send(DemoWriter().header(0, 7).bytes());
    ASSERT_TRUE(server_.accept()) << log();
    EXPECT_THAT(log(), HasSubstr(": a block of type 7, expected 1 to 6; connecting again in "));
}

TEST_F(QtvPublisher, ASignalEndsTheMatch) {
    start();
    ASSERT_TRUE(server_.accept());
    server_.send(begin);
    server_.send(level("dm3").bytes());
    (void)next_info();
    publisher_->send_signal(SIGTERM);
    EXPECT_EQ(publisher_->wait(), 0) << log();
    EXPECT_TRUE(eventually([&] { return director_->info_has_ended(); }));
}

TEST_F(QtvPublisher, ASignalEndsTheWaitForAServer) {
    server_.close();
    start();
    ASSERT_TRUE(server_.accept());
    server_.send("QTVSV 1\nERROR: full\n\n");
    EXPECT_TRUE(eventually([&] {
        return log().find("the server refuses the stream: full; connecting again in 1 s") !=
               std::string::npos;
    })) << log();
    publisher_->send_signal(SIGINT);
    EXPECT_EQ(publisher_->wait(), 0) << log();
}

TEST_F(QtvPublisher, SendsThePasswordAndTheSource) {
    const TemporaryFolder folder;
    std::ofstream(folder / "password") << "open sesame\n";
    start({"--password-file", (folder / "password").string(), "--source", "3"});
    EXPECT_EQ(server_.accept(), "QTV\nVERSION: 1\nSOURCE: 3\nAUTH: PLAIN\nPASSWORD: \"open sesame\"\n\n");
    server_.send("QTVSV 1\nPERROR: Bad password.\n\n");
    EXPECT_EQ(publisher_->wait(), 1);
    EXPECT_THAT(log(), HasSubstr("the server refuses the stream: Bad password.\n"));
}

TEST(QtvPublisherCommandLine, HelpIsPrintedAndBadUsageIsRefused) {
    ChildProcess help({program, "--help"});
    EXPECT_EQ(help.wait(), 0);
    EXPECT_THAT(help.output(), HasSubstr("--password-file"));
    for (const std::vector<std::string>& wrong : {std::vector<std::string>{},
                                                  {"a:1", "--domain", "231"},
                                                  {"a:1", "surplus"},
                                                  {"a:1", "--nonsense"}}) {
        std::vector<std::string> command = {program};
        command.insert(command.end(), wrong.begin(), wrong.end());
        ChildProcess child(command);
        EXPECT_EQ(child.wait(), 2);
        EXPECT_NE(child.errors(), "");
    }
    ChildProcess no_port({program, "host"});
    EXPECT_EQ(no_port.wait(), 1);
    EXPECT_EQ(no_port.errors(), "qtv-publisher: 'host': expected HOST:PORT\n");
    ChildProcess no_password({program, "host:1", "--password-file", "/dev/null"});
    EXPECT_EQ(no_password.wait(), 1);
    EXPECT_NE(no_password.errors(), "");
}

}  // namespace
}  // namespace camdir::test
