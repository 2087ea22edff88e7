#include "recording.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"
#include "unpacked.hpp"

namespace camdir::openarena {
namespace {

using test::unpacked;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;

class OpenArenaRecording : public testing::Test {
  protected:
    OpenArenaRecording() {
        frame->level_time = 1500;
        player_pose& pose = frame->players[2];
        pose.in_game = pose.alive = pose.teleport_bit = 1;
        pose.team = team_red;
        pose.health = 90;
        pose.weapon = 5;
        pose.viewheight = 26;
        pose.origin[0] = 1.25F;
        pose.angles[1] = -90.0F;
        pose.velocity[2] = -3.5F;
        frame->players[3] = pose;
        frame->players[3].spectator = 1;
        players[2].in_use = 1;
        players[2].team = team_red;
        std::copy_n("A,b", 4, players[2].name);
    }

    recording* open(const std::string& map = "oa_dm1") {
        return recording_open((folder / "m").c_str(), map.c_str(), 1'000'000'000, reason, sizeof reason);
    }
    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            names.push_back(entry.path().filename().string());
        }
        std::sort(names.begin(), names.end());
        return names;
    }
    std::string content(const std::string& end) const {
        for (const std::string& name : files()) {
            if (name.ends_with(end)) return unpacked(folder / name);
        }
        return "no file";
    }

    test::TemporaryFolder folder;
    std::unique_ptr<server_frame> frame = std::make_unique<server_frame>();
    match_player players[max_slots] = {};
    char reason[300] = "";
};

TEST_F(OpenArenaRecording, WritesWhatEvaluateReads) {
    recording* match = open();
    ASSERT_NE(match, nullptr) << reason;
    recording_set_players(match, players);
    frame->event_count = 3;
    frame->events[0] = {CDIR_EVENT_KILL, 1, 2, 1.0F, "MOD_ROCKET"};
    frame->events[1] = {CDIR_EVENT_KILL, no_slot, 2, 0.0F, "MOD_FALLING"};
    frame->events[2] = {CDIR_EVENT_DAMAGE, 1, 2, 40.0F, ""};
    frame->mover_count = 1;
    frame->movers[0] = {4, {0.0F, 0.0F, -8.0F}, {0.0F, 90.0F, 0.0F}};
    ASSERT_TRUE(recording_add_frame(match, frame.get()));
    frame->level_time += 50;
    frame->event_count = frame->mover_count = 0;
    ASSERT_TRUE(recording_add_frame(match, frame.get()));
    EXPECT_EQ(recording_rows(match), 2);
    EXPECT_THAT(files(), testing::Each(EndsWith(".part")));
    ASSERT_TRUE(recording_close(match, reason, sizeof reason)) << reason;

    EXPECT_EQ(files().size(), 4U);
    EXPECT_THAT(files()[3], testing::MatchesRegex("m-oa_dm1-2001090[89]-[0-9]{6}.csv.gz"));
    EXPECT_EQ(unpacked(folder / files()[3]),
              "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,health,team,teleport_bit,alive,weapon\n"
              "0,2,1.25,0.00,0.00,0.00,-90.00,0.00,0.0,0.0,-3.5,26,90,1,1,1,5\n"
              "50,2,1.25,0.00,0.00,0.00,-90.00,0.00,0.0,0.0,-3.5,26,90,1,1,1,5\n");
    EXPECT_EQ(
        content("-events.csv.gz"),
        "t_ms,kind,actor,subject,value\n0,kill,1,2,MOD_ROCKET\n0,death,,2,MOD_FALLING\n0,damage,1,2,40\n");
    EXPECT_EQ(content("-movers.csv.gz"),
              "t_ms,mover,x,y,z,pitch,yaw,roll\n0,4,0.00,0.00,-8.00,0.00,90.00,0.00\n");
    EXPECT_EQ(content("-players.csv"), "player,name,team,since_ms\n2,A_b,1,0\n");
}

TEST_F(OpenArenaRecording, WhoTakesASlotThatWasLeftIsAnotherPlayer) {
    recording* match = open();
    ASSERT_NE(match, nullptr) << reason;
    const auto frame_with = [&](const std::string& name, int in_use = 1) {
        players[2].in_use = static_cast<std::uint8_t>(in_use);
        std::copy_n(name.c_str(), name.size() + 1, players[2].name);
        recording_set_players(match, players);
        frame->players[2].in_game = players[2].in_use;
        EXPECT_TRUE(recording_add_frame(match, frame.get()));
        frame->level_time += 50;
    };
    frame_with("anna");
    frame_with("ann");  // has changed the name
    frame_with("", 0);
    frame_with("bart");  // at the same place, without a teleport
    frame_with("", 0);
    frame_with("bart");
    EXPECT_TRUE(recording_close(match, reason, sizeof reason)) << reason;
    EXPECT_EQ(content("-players.csv"),
              "player,name,team,since_ms\n2,anna,1,0\n2,ann,1,50\n2,bart,1,150\n2,bart,1,250\n");
    std::string teleport_bits;
    std::istringstream rows(unpacked(folder / files()[3]));
    std::string row;
    std::getline(rows, row);
    const std::string header = row;
    while (std::getline(rows, row)) {
        std::istringstream fields(row), names(header);
        std::string field, name;
        while (std::getline(names, name, ',') && std::getline(fields, field, ','))
            if (name == "teleport_bit") teleport_bits += field;
    }
    EXPECT_EQ(teleport_bits, "1101");
}

// A file may not grow beyond 100 kB, as on a full disk.
TEST_F(OpenArenaRecording, AFullDiskLeavesWhatWasWritten) {
    recording* match = open();
    ASSERT_NE(match, nullptr) << reason;
    recording_set_players(match, players);
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
    const rlimit small{100'000, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    std::minstd_rand random;
    bool good = true;
    for (int i = 0; i < 100'000 && good; ++i) {
        frame->players[2].origin[0] = static_cast<float>(random() % 10'000'000) / 100.0F;
        good = recording_add_frame(match, frame.get());
        frame->level_time += 50;
    }
    EXPECT_FALSE(good);
    EXPECT_FALSE(recording_close(match, reason, sizeof reason));
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(reason, HasSubstr("File too large"));
    EXPECT_THAT(reason, HasSubstr(folder.path().string() + "/m-oa_dm1-"));
    EXPECT_EQ(files().size(), 4U);
    EXPECT_THAT(files(), testing::Each(EndsWith(".part")));
    EXPECT_GT(unpacked(folder / files()[3]).size(), 100'000U);
    EXPECT_THAT(content("-players.csv.part"), HasSubstr("2,A_b,1,0"));
}

TEST_F(OpenArenaRecording, AnEmptyOneLeavesNoFile) {
    recording* match = open();
    ASSERT_NE(match, nullptr);
    *frame = server_frame{};
    EXPECT_TRUE(recording_add_frame(match, frame.get()));
    EXPECT_TRUE(recording_close(match, reason, sizeof reason));
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(OpenArenaRecording, TwoWithinASecondKeepApart) {
    for (int i = 0; i < 3; ++i) {
        recording* match = open("maps/a");
        ASSERT_NE(match, nullptr) << reason;
        EXPECT_TRUE(recording_add_frame(match, frame.get()));
        EXPECT_TRUE(recording_close(match, reason, sizeof reason));
    }
    EXPECT_EQ(files().size(), 12U);
    EXPECT_THAT(files(), testing::Each(HasSubstr("m-maps_a-")));
}

TEST_F(OpenArenaRecording, AFolderThatIsMissingIsNamed) {
    EXPECT_EQ(recording_open("/nonexistent/m", "oa_dm1", 0, reason, sizeof reason), nullptr);
    EXPECT_THAT(reason, HasSubstr("/nonexistent/m-oa_dm1"));
    EXPECT_THAT(reason, HasSubstr("No such file"));
}

// The longest rows that values can make fit.
TEST(OpenArenaRows, FitAtTheExtremes) {
    player_pose pose{};
    mover_pose mover{};
    for (int i = 0; i < 3; ++i) {
        pose.origin[i] = pose.velocity[i] = pose.angles[i] = -1e9F;
        mover.origin[i] = mover.angles[i] = -1e9F;
    }
    char row[max_row];
    EXPECT_LT(pose_row(row, 1LL << 40, 63, &pose), max_row);
    EXPECT_LT(mover_row(row, 1LL << 40, &mover), max_row);
    const game_event event = {200, 1, 2, -1e30F, ""};
    EXPECT_LT(event_row(row, 1LL << 40, &event), max_row);
}

}  // namespace
}  // namespace camdir::openarena
