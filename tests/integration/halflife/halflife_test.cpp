// The Metamod plugin in a process that acts the Half-Life server, with a director at its well-known port.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "integration/sdk/directors_domain.hpp"
#include "integration/sdk/fake_director.hpp"
#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Words = std::vector<std::string>;

constexpr std::uint32_t none = 0xffffffffU;
constexpr std::uint32_t alive = 1;
constexpr std::uint32_t spectator = 4;

// The variables name another build's programs: that for i386.
std::string program(const char* variable, const char* built) {
    const char* named = std::getenv(variable);
    return named != nullptr ? named : built;
}

std::string text_of(const camera_director_MatchEvent& event) {
    const auto player = [](std::uint32_t id) { return id == none ? "none" : std::to_string(id); };
    return std::to_string(event.kind) + " " + player(event.actor) + " " + player(event.subject) + " " +
           std::to_string(static_cast<int>(event.value)) + " " + event.detail;
}

class HalfLife : public testing::Test {
  protected:
    void SetUp() override {
        ASSERT_TRUE(domain_.joined()) << "every domain is taken";
        director_.emplace(domain_.number(), "cup");
    }

    // Starts a server that does what the words say: see host.c.
    void start(const Words& words) {
        Words command = {program("CAMDIR_HALFLIFE_HOST", CAMDIR_BUILT_HALFLIFE_HOST),
                         program("CAMDIR_HALFLIFE_PLUGIN", CAMDIR_BUILT_HALFLIFE_PLUGIN),
                         "set",
                         "director_match",
                         "cup",
                         "set",
                         "director_domain",
                         domain_.text()};
        command.insert(command.end(), words.begin(), words.end());
        server_.emplace(command);
    }

    // A file for which the server waits; and ends the wait.
    [[nodiscard]] std::string file(const std::string& name) const { return (folder_.path() / name).string(); }
    void create(const std::string& name) const { std::ofstream(file(name)) << "\n"; }

    [[nodiscard]] std::optional<ReceivedInfo> next_info() {
        std::optional<ReceivedInfo> info;
        EXPECT_TRUE(eventually([&] { return (info = director_->take_info()).has_value(); }))
            << server_->errors();
        return info;
    }

    // The first frame for which `holds` is true.
    template <class Condition>
    [[nodiscard]] std::optional<ReceivedPoses> next_poses(const Condition& holds) {
        std::optional<ReceivedPoses> poses;
        EXPECT_TRUE(eventually([&] {
            poses = director_->take_poses();
            return poses && holds(*poses);
        })) << server_->errors();
        return poses;
    }

    void expect_end() { EXPECT_EQ(server_->wait(), 0) << server_->errors(); }

    DirectorsDomain domain_;
    TemporaryFolder folder_;
    std::optional<FakeDirector> director_;
    std::optional<ChildProcess> server_;
};

TEST_F(HalfLife, PublishesTheMatchAndThePosesOfItsPlayers) {
    start({"map", "crossfire", "join", "1",          "anna",   "2",        "join", "3",     "bart",
           "1",   "join",      "8",    "carl",       "0",      "spectate", "8",    "place", "1",
           "100", "200",       "300",  "30",         "90",     "0",        "walk", "1",     "160",
           "0",   "0",         "wait", file("seen"), "status", "detach"});
    const auto info = next_info();
    ASSERT_TRUE(info);
    EXPECT_EQ(info->map_name, "crossfire");
    EXPECT_EQ(info->rate_hz, 100.0F);
    EXPECT_FLOAT_EQ(info->metres_per_unit, 0.0254F);
    EXPECT_THAT(info->player_id, ElementsAre(1, 3, 8));
    EXPECT_THAT(info->player_name, ElementsAre("anna", "bart", "carl"));
    EXPECT_THAT(info->player_team, ElementsAre(2, 1, 0));

    const auto first = next_poses([](const ReceivedPoses&) { return true; });
    ASSERT_TRUE(first);
    const auto poses = next_poses([&](const ReceivedPoses& later) {
        EXPECT_GT(later.frame_time, first->frame_time);
        return later.frame_time > first->frame_time + 200'000'000;
    });
    ASSERT_TRUE(poses);
    EXPECT_EQ(poses->epoch, info->epoch);
    ASSERT_THAT(poses->player_id, ElementsAre(1, 3, 8));
    EXPECT_THAT(poses->flags, ElementsAre(alive, alive, spectator));
    const double seconds = static_cast<double>(poses->frame_time) * 1e-9 - 1.0;
    EXPECT_NEAR(poses->eye[0], 100.0 + 160.0 * seconds, 0.1);
    EXPECT_EQ(poses->eye[1], 200.0F);
    EXPECT_EQ(poses->eye[2], 328.0F);
    EXPECT_EQ(poses->velocity[0], 160.0F);
    // Yaw 90 degrees turns x to y; pitch 30 degrees looks down: forward is (0, cos 30, -sin 30).
    const float* q = poses->orientation.data();
    EXPECT_NEAR(1.0F - 2.0F * (q[1] * q[1] + q[2] * q[2]), 0.0F, 1e-5F);
    EXPECT_NEAR(2.0F * (q[0] * q[1] + q[3] * q[2]), 0.8660254F, 1e-5F);
    EXPECT_NEAR(2.0F * (q[0] * q[2] - q[3] * q[1]), -0.5F, 1e-5F);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    EXPECT_NEAR(static_cast<double>(poses->source_time),
                static_cast<double>(std::chrono::nanoseconds(now).count()), 60e9);

    create("seen");
    expect_end();
    EXPECT_TRUE(eventually([&] { return director_->info_has_ended(); })) << "detached";
    EXPECT_THAT(server_->output(), HasSubstr("director match: cup\n"));
    EXPECT_THAT(server_->output(), HasSubstr("director map: crossfire\n"));
    EXPECT_THAT(server_->output(), HasSubstr("director state: publishing\n"));
}

TEST_F(HalfLife, PublishesKillsDamageItemsAndRounds) {
    start({"map",    "crossfire",
           "join",   "1",
           "anna",   "0",
           "join",   "2",
           "bart",   "0",
           "rounds", file("matched"),
           "map",    "crossfire",
           "join",   "1",
           "anna",   "0",
           "join",   "2",
           "bart",   "0",
           "run",    "2",
           "round",  "run",
           "2",      "hurt",
           "1",      "2",
           "30",     "run",
           "2",      "rocket",
           "2",      "1",
           "45",     "run",
           "2",      "wild",
           "1",      "run",
           "2",      "pickup",
           "2",      "item_longjump",
           "run",    "2",
           "kill",   "2",
           "1",      "crossbow",
           "run",    "2",
           "kill",   "0",
           "2",      "a\nvery long name of the means of a kill",
           "run",    "20",
           "end",    "round",
           "wait",   file("seen"),
           "status"});
    std::optional<camera_director_MatchEvent> event;
    ASSERT_TRUE(eventually([&] { return (event = director_->take_event()).has_value(); }))
        << server_->errors();
    const std::uint64_t warm_up = event->epoch;
    EXPECT_THAT(text_of(*event), testing::MatchesRegex("8 none none [0-9]+ begin"));
    create("matched");
    Words events;
    EXPECT_TRUE(eventually([&] {
        while ((event = director_->take_event()))
            if (event->epoch != warm_up) events.push_back(text_of(*event));
        return events.size() >= 9;
    }));
    create("seen");
    expect_end();
    EXPECT_THAT(events, ElementsAre("8 none none 1 begin", "5 2 1 30 ", "5 1 2 45 ", "5 none 1 1 ",
                                    "7 2 none 0 item_longjump", "1 2 1 0 crossbow", "5 none 1 69 ",
                                    "1 none 2 0 a?very long name of the means o", "5 1 2 55 "));
    EXPECT_FALSE(director_->take_event()) << "between two maps";
    EXPECT_THAT(server_->output(), HasSubstr("director events dropped: 0\n"));
}

TEST_F(HalfLife, EveryMapIsANewEpoch) {
    start({"map",          "crossfire", "join",      "1",         "anna", "0",          "wait", file("first"),
           "end",          "map",       "boot_camp", "join",      "2",    "bart",       "0",    "wait",
           file("second"), "end",       "map",       "boot_camp", "wait", file("third")});
    const auto first = next_info();
    ASSERT_TRUE(first);
    const auto moves_to = [&](std::uint64_t epoch) {
        return next_poses([&](const ReceivedPoses& poses) { return poses.epoch == epoch; });
    };
    ASSERT_TRUE(next_poses(
        [&](const ReceivedPoses& poses) { return poses.epoch == first->epoch && poses.frame_number > 20; }));
    create("first");
    const auto second = next_info();
    ASSERT_TRUE(second);
    EXPECT_GT(second->epoch, first->epoch);
    EXPECT_EQ(second->map_name, "boot_camp");
    EXPECT_THAT(second->player_id, ElementsAre(2));
    const auto poses = moves_to(second->epoch);
    ASSERT_TRUE(poses);
    EXPECT_LE(poses->frame_number * 10'000'000LL, poses->frame_time - 1'000'000'000)
        << "numbers begin with the epoch, as does the game's clock at 1 s";
    create("second");
    const auto third = next_info();
    ASSERT_TRUE(third);
    EXPECT_GT(third->epoch, second->epoch);
    EXPECT_EQ(third->map_name, "boot_camp");
    const auto empty = moves_to(third->epoch);
    ASSERT_TRUE(empty);
    EXPECT_THAT(empty->player_id, IsEmpty());
    create("third");
    expect_end();
    EXPECT_TRUE(eventually([&] { return director_->info_has_ended(); })) << "the server has ended";
}

TEST_F(HalfLife, ThePoseRateIsLimited) {
    start({"set", "director_max_rate", "20", "map", "crossfire", "join", "1", "anna", "0", "wait",
           file("seen")});
    const auto info = next_info();
    ASSERT_TRUE(info);
    EXPECT_EQ(info->rate_hz, 20.0F);
    std::int64_t previous = 0;
    for (int i = 0; i < 10; ++i) {
        const auto poses = next_poses([](const ReceivedPoses&) { return true; });
        ASSERT_TRUE(poses);
        EXPECT_GE(poses->frame_time - previous, 45'000'000);
        previous = poses->frame_time;
    }
    create("seen");
    expect_end();
}

TEST_F(HalfLife, SettingsTakeEffectDuringAMap) {
    start({"map",
           "crossfire",
           "join",
           "1",
           "anna",
           "0",
           "expect",
           "director directors: 1\n",
           "wait",
           file("known"),
           "set",
           "director_enable",
           "0",
           "expect",
           "director state: disabled\n",
           "wait",
           file("seen"),
           "set",
           "director_enable",
           "1",
           "expect",
           "director directors: 1\n",
           "wait",
           file("back")});
    EXPECT_TRUE(eventually([&] { return director_->take_poses().has_value(); }));
    EXPECT_TRUE(next_info());
    create("known");
    EXPECT_TRUE(eventually([&] { return director_->info_has_ended(); }));
    create("seen");
    EXPECT_TRUE(eventually([&] { return !director_->info_has_ended(); }));
    create("back");
    expect_end();
}

TEST_F(HalfLife, AnErrorOfTheSettingsIsInTheStatusAndTheServerRunsOn) {
    start({"set", "director_interface", "no_such_interface", "map", "crossfire", "join", "1", "anna", "0",
           "expect", "director state: cannot join", "set", "director_interface", "lo", "expect",
           "director directors: 1\n"});
    expect_end();
}

TEST_F(HalfLife, ASettingThatDoesNotFitIsInTheStatusAndNothingIsPublished) {
    start({"set", "director_domain", "231", "map", "crossfire", "expect",
           "director state: director_domain '231': expected a number from 0 to 230", "set", "director_domain",
           "none", "expect", "director state: director_domain 'none': expected a number from 0 to 230", "set",
           "director_match", std::string(64, 'm'), "expect",
           "director state: director_match is longer than 63 bytes"});
    expect_end();
}

// A rate that is no number, and one of a frame in 1000 s.
TEST_F(HalfLife, TheMatchIsPublishedAgainOnceItsRateIsRightAgain) {
    start({"map",
           "crossfire",
           "join",
           "1",
           "anna",
           "0",
           "expect",
           "director directors: 1\n",
           "wait",
           file("known"),
           "set",
           "director_max_rate",
           "fast",
           "expect",
           "director state: director_max_rate must be 1 to 1000",
           "set",
           "director_max_rate",
           "0.001",
           "run",
           "200",
           "wait",
           file("ended"),
           "set",
           "director_max_rate",
           "20",
           "wait",
           file("seen")});
    const auto before = next_info();
    ASSERT_TRUE(before);
    create("known");
    EXPECT_TRUE(eventually([&] { return director_->info_has_ended(); })) << "nothing is published";
    create("ended");
    EXPECT_TRUE(next_poses([&](const ReceivedPoses& poses) { return poses.epoch > before->epoch; }));
    create("seen");
    expect_end();
}

TEST_F(HalfLife, TheMatchIsAnnouncedAnewWhenTheDirectorIsLost) {
    start({"map", "crossfire", "join", "1", "anna", "0", "expect", "director directors: 1\n", "create",
           file("met"), "expect", "director directors: 0\n", "create", file("missed"), "wait", file("seen")});
    const auto before = next_info();
    ASSERT_TRUE(before);
    ASSERT_TRUE(next_poses([](const ReceivedPoses&) { return true; }));
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(file("met")); }));
    director_.reset();
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(file("missed")); }));
    director_.emplace(domain_.number(), "cup");
    EXPECT_TRUE(next_poses([&](const ReceivedPoses& poses) { return poses.epoch > before->epoch; }));
    create("seen");
    expect_end();
}

TEST_F(HalfLife, PlayersComeAndGo) {
    start({"map", "crossfire", "join", "1", "anna", "0", "wait", file("one"), "join", "2", "bart", "3",
           "wait", file("two"), "leave", "1", "wait", file("left")});
    const auto wait_for = [&](const std::vector<std::uint32_t>& ids) {
        EXPECT_TRUE(next_poses([&](const ReceivedPoses& poses) { return poses.player_id == ids; }));
        EXPECT_TRUE(eventually([&] {
            const auto info = director_->take_info();
            return info && info->player_id == ids;
        }));
    };
    wait_for({1});
    create("one");
    wait_for({1, 2});
    create("two");
    wait_for({2});
    create("left");
    expect_end();
}

}  // namespace
}  // namespace camdir::test
