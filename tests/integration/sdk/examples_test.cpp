// The example programs as child processes, with a director at its well-known port: the SDK's default network
// settings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <sstream>
#include <string>
#include <vector>

#include "directors_domain.hpp"
#include "fake_director.hpp"
#include "support/child_process.hpp"

namespace camdir::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::string game_server = std::string(CAMDIR_BIN_DIR) + "/example-game-server";
const std::string observer = std::string(CAMDIR_BIN_DIR) + "/example-observer";

class Examples : public testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(domain_.joined()) << "every domain is taken"; }

    DirectorsDomain domain_;
};

// Answers each pose with a camera 50 units above the player's eye.
void direct(FakeDirector& director, const ReceivedPoses& poses, std::uint32_t number) {
    CameraFrameArrays frame{.match_id = poses.match_id};
    frame.epoch = poses.epoch;
    frame.frame_number = number;
    frame.pose_number = poses.frame_number;
    frame.frame_time = poses.frame_time;
    frame.source_time = poses.source_time;
    frame.add_camera(6, poses.eye[0], 2);
    frame.target[0] = poses.player_id[0];
    frame.position[1] = poses.eye[1];
    frame.position[2] = poses.eye[2] + 50.0F;
    director.write(frame);
}

struct Line {
    std::int64_t frame_time;
    double x;
    double y;
    double z;
};

// The last line may not be complete yet.
std::vector<Line> lines_of(const std::string& csv) {
    std::istringstream stream(csv);
    std::string text;
    if (!std::getline(stream, text) || stream.eof()) return {};
    EXPECT_THAT(text, StartsWith("frame_time,target,x,y,z,"));
    std::vector<Line> lines;
    while (std::getline(stream, text) && !stream.eof()) {
        Line line{};
        unsigned target = 0;
        EXPECT_EQ(std::sscanf(text.c_str(), "%ld,%u,%lf,%lf,%lf,", &line.frame_time, &target, &line.x,
                              &line.y, &line.z),
                  5)
            << text;
        lines.push_back(line);
    }
    return lines;
}

// Where answers are further apart, because a process had to wait, the camera does not move as the player did.
bool is_between_close_answers(std::int64_t time, const std::vector<std::int64_t>& answers) {
    const auto after = std::ranges::upper_bound(answers, time);
    // Those whose cameras the way depends on.
    const auto first = after - std::min<std::ptrdiff_t>(4, after - answers.begin());
    const auto last = after + std::min<std::ptrdiff_t>(2, answers.end() - after);
    const auto are_apart = [](std::int64_t one, std::int64_t next) {
        return next - one > 100'000'000;  // ns, in which the player turns by 0.2 rad
    };
    return std::adjacent_find(first, last, are_apart) == last;
}

TEST_F(Examples, ObserverPrintsTheDirectorsCameraOfTheWalkingPlayer) {
    FakeDirector director(domain_.number(), "example");
    ChildProcess server({game_server, "--domain", domain_.text(), "--radius", "100", "--centre", "10,20,30"});
    ChildProcess watcher({observer, "--domain", domain_.text(), "--target", "1", "--profile", "chase"});

    std::optional<ReceivedRequest> request;
    ASSERT_TRUE(eventually([&] { return (request = director.take_request()).has_value(); }))
        << watcher.errors();
    EXPECT_EQ(request->target, 1U);
    EXPECT_EQ(request->profile, "chase");
    EXPECT_EQ(request->observer_id, "example-observer");

    std::uint32_t number = 0;
    std::vector<std::int64_t> answers;
    const auto smooth_lines = [&] {
        std::vector<Line> lines = lines_of(watcher.output());
        std::erase_if(lines,
                      [&](const Line& line) { return !is_between_close_answers(line.frame_time, answers); });
        return lines;
    };
    ASSERT_TRUE(eventually([&] {
        (void)director.show_match();
        while (const auto poses = director.take_poses()) {
            if (number == 0) director.write_status("example-observer", poses->epoch, 1, 6);
            direct(director, *poses, number++);
            answers.push_back(poses->frame_time);
        }
        return smooth_lines().size() >= 60 && watcher.errors().find("target: walker") != std::string::npos;
    })) << server.errors()
        << watcher.errors();

    server.send_signal(SIGINT);
    watcher.send_signal(SIGTERM);
    EXPECT_EQ(server.wait(), 0) << server.errors();
    EXPECT_EQ(watcher.wait(), 0) << watcher.errors();
    EXPECT_THAT(server.errors(), HasSubstr("directors: 1"));
    EXPECT_THAT(watcher.errors(), HasSubstr("shot: accepted"));
    EXPECT_THAT(watcher.errors(), HasSubstr("invalid 0"));
    std::int64_t last_time = 0;
    for (const Line& line : lines_of(watcher.output())) {
        EXPECT_GE(line.frame_time, last_time);
        last_time = line.frame_time;
        EXPECT_NEAR(line.z, 80.0, 1e-3);
    }
    for (const Line& line : smooth_lines())
        EXPECT_NEAR(std::hypot(line.x - 10.0, line.y - 20.0), 100.0, 1.0) << "interpolated along the circle";
}

TEST_F(Examples, AnObserverWithoutADirectorFailsAndSaysSo) {
    ChildProcess watcher({observer, "--domain", domain_.text(), "--seconds", "0.2"});
    EXPECT_EQ(watcher.wait(), 1);
    EXPECT_THAT(watcher.errors(), HasSubstr("no camera after 0.2 s: is a director at --directors"));
}

TEST_F(Examples, AnObserverThatNeverGetsACameraSaysWhatTheDirectorAnsweredLast) {
    FakeDirector director(domain_.number(), "example");
    ChildProcess server({game_server, "--domain", domain_.text()});
    bool asked = false;
    const auto last_words = [&](const std::string& patience) {
        ChildProcess watcher(
            {observer, "--domain", domain_.text(), "--target", "3,1", "--patience", patience});
        EXPECT_TRUE(eventually(
            [&] {
                (void)director.show_match();
                while (const auto request = director.take_request()) {
                    asked = true;
                    EXPECT_EQ(request->target, CDIR_SHOW_GROUP);
                    EXPECT_EQ(request->group, (std::vector<std::uint32_t>{3, 1}));
                }
                while (const auto poses = director.take_poses())
                    director.write_status("example-observer", poses->epoch, CDIR_SHOT_WAITING_FOR_MAP, 0,
                                          "the delay");
                return watcher.errors().find("no camera after") != std::string::npos;
            },
            std::chrono::minutes(3)))
            << watcher.errors();
        EXPECT_EQ(watcher.wait(), 1);
        return watcher.errors();
    };
    std::string words = last_words("3");
    // On a busy machine the answer takes longer to arrive.
    if (words.find("last answer") == std::string::npos) words = last_words("45");
    EXPECT_TRUE(asked);
    EXPECT_THAT(words, HasSubstr("the director's last answer: waiting for the map: the delay"));
    EXPECT_THAT(words, HasSubstr("a longer --seconds or --patience waits for more"));
    server.send_signal(SIGINT);
    EXPECT_EQ(server.wait(), 0);
}

TEST_F(Examples, GameServerThatIsKilledIsNoticed) {
    FakeDirector director(domain_.number(), "example");
    ChildProcess server({game_server, "--domain", domain_.text()});
    ASSERT_TRUE(eventually([&] { return director.take_info().has_value(); })) << server.errors();
    server.send_signal(SIGKILL);
    EXPECT_EQ(server.wait(), -SIGKILL);
    EXPECT_TRUE(eventually([&] { return director.info_has_ended(); }));
}

TEST_F(Examples, ObserverGivesUpWithoutADirector) {
    ChildProcess watcher({observer, "--domain", domain_.text(), "--patience", "0.2"});
    EXPECT_EQ(watcher.wait(), 1);
    EXPECT_THAT(watcher.errors(), HasSubstr("no camera after 0.2 s"));
}

TEST(ExamplesCommandLine, HelpIsPrintedAndBadUsageIsRefused) {
    for (const std::string& program : {game_server, observer}) {
        ChildProcess help({program, "--help"});
        EXPECT_EQ(help.wait(), 0);
        EXPECT_THAT(help.output(), HasSubstr("--directors LIST"));
        for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--nonsense"},
                                                      {"--domain"},
                                                      {"--domain", "x"},
                                                      {"--domain", "233"},
                                                      {"--rate", "0"},
                                                      {"--rate", "nan"},
                                                      {"surplus"}}) {
            std::vector<std::string> command = {program};
            command.insert(command.end(), wrong.begin(), wrong.end());
            ChildProcess child(command);
            EXPECT_EQ(child.wait(), 2) << wrong[0];
            EXPECT_NE(child.errors(), "") << wrong[0];
            EXPECT_EQ(child.output(), "") << wrong[0];
        }
    }
    for (const char* target :
         {"bob", "", "-1", "1.5", "4294967294", "99999999999999999999", "1,", ",1", "1,2,3,4,5"}) {
        ChildProcess child({observer, "--target", target});
        EXPECT_EQ(child.wait(), 2) << target;
        EXPECT_THAT(child.errors(),
                    HasSubstr("--target: expected auto, a player's number, or those of a group"))
            << target;
    }
    ChildProcess bad_match({game_server, "--match", "a/b"});
    EXPECT_EQ(bad_match.wait(), 1);
    EXPECT_THAT(bad_match.errors(), HasSubstr("match_id"));
    ChildProcess long_match({game_server, "--match", std::string(500, 'x')});
    EXPECT_EQ(long_match.wait(), 1);
    EXPECT_THAT(long_match.errors(), HasSubstr("match_id"));
}

}  // namespace
}  // namespace camdir::test
