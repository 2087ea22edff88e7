// The recorded matches and camera paths that film.sh plays.
#include "film/take.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "engine.h"
#include "film/scenery.h"
#include "support/temporary_folder.hpp"

namespace camdir::openarena {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string trace_header = "t_ms,player,x,y,z,pitch,yaw,vx,vy,vz,viewheight,teleport_bit,alive\n";
const std::string mover_header = "t_ms,mover,x,y,z,pitch,yaw,roll\n";
const std::string camera_header = "t_ms,player,x,y,z,qw,qx,qy,qz,cut\n";

// Opens what is written into two files.
class Files {
  public:
    Files(const std::string& trace, const std::string& cameras, const std::string& movers = "") {
        std::ofstream(folder_ / "trace.csv") << trace;
        std::ofstream(folder_ / "cameras.csv") << cameras;
        std::array<char, 1000> text{};
        if (!movers.empty()) std::ofstream(folder_ / "movers.csv") << movers;
        opened = take_open(&content, (folder_ / "trace.csv").c_str(), (folder_ / "cameras.csv").c_str(),
                           movers.empty() ? "" : (folder_ / "movers.csv").c_str(), text.data(), text.size());
        reason = text.data();
    }
    ~Files() { take_close(&content); }
    Files(const Files&) = delete;
    Files& operator=(const Files&) = delete;

    take content{};
    bool opened = false;
    std::string reason;

  private:
    test::TemporaryFolder folder_;
};

TEST(Take, PosesAreInterpolatedInTimeAndTheShortWayRoundTheCircle) {
    const Files files(trace_header +
                          "100,4,0,0,0,0,170,0,0,0,26,1,1\n"
                          "200,4,10,20,30,-8,-170,100,0,0,26,1,1\n",
                      camera_header + "100,4,0,0,0,1,0,0,0,1\n");
    ASSERT_TRUE(files.opened) << files.reason;
    const recorded_pose pose = take_pose(&files.content, 0, 150);
    EXPECT_TRUE(pose.present && pose.alive);
    EXPECT_THAT(pose.origin, ElementsAre(5, 10, 15));
    EXPECT_THAT(pose.angles, ElementsAre(-4, 180, 0));
    EXPECT_THAT(pose.velocity, ElementsAre(50, 0, 0));
}

TEST(Take, APlayerWhoTeleportsStaysUntilThen) {
    const Files files(trace_header + "100,4,0,0,0,0,0,0,0,0,26,0,1\n200,4,900,0,0,0,0,0,0,0,26,1,1\n",
                      camera_header + "100,4,0,0,0,1,0,0,0,1\n");
    EXPECT_EQ(take_pose(&files.content, 0, 199).origin[0], 0);
    EXPECT_EQ(take_pose(&files.content, 0, 200).origin[0], 900);
}

TEST(Take, APlayerWithoutRowsIsNotInTheMatch) {
    const Files files(trace_header + "100,4,0,0,0,0,0,0,0,0,26,0,1\n5000,4,0,0,0,0,0,0,0,0,26,0,1\n",
                      camera_header + "100,4,0,0,0,1,0,0,0,1\n");
    EXPECT_FALSE(take_pose(&files.content, 0, 99).present);
    EXPECT_TRUE(take_pose(&files.content, 0, 300).present);
    EXPECT_FALSE(take_pose(&files.content, 0, 4000).present);
    EXPECT_FALSE(take_pose(&files.content, 0, 6000).present);
}

TEST(Take, ACutIsReportedOnceAndNothingIsBlendedAcrossIt) {
    const Files files(trace_header + "0,4,0,0,0,0,0,0,0,0,26,0,1\n",
                      camera_header + "0,4,0,0,0,1,0,0,0,0\n100,4,50,0,0,1,0,0,0,1\n");
    const track* const camera = tracks_find(&files.content.cameras, 4);
    ASSERT_NE(camera, nullptr);
    bool cut = true;
    EXPECT_EQ(take_view(&files.content, camera, 40, 90, &cut).position[0], 0);
    EXPECT_FALSE(cut);
    EXPECT_EQ(take_view(&files.content, camera, 90, 110, &cut).position[0], 50);
    EXPECT_TRUE(cut);
    (void)take_view(&files.content, camera, 110, 130, &cut);
    EXPECT_FALSE(cut);
}

TEST(Take, ErrorsNameTheFileTheLineAndTheColumn) {
    const std::string camera = camera_header + "0,4,0,0,0,1,0,0,0,0\n";
    EXPECT_THAT(Files("t_ms,player,x\n0,1,2\n", camera).reason,
                HasSubstr("trace.csv, line 1: the header lacks the column 'y'"));
    EXPECT_THAT(Files(trace_header + "0,4,0,none,0,0,0,0,0,0,26,0,1\n", camera).reason,
                HasSubstr("trace.csv, line 2: expected a number in column 'y'"));
    EXPECT_THAT(Files(trace_header + "0,4,0,0\n", camera).reason, HasSubstr("line 2: expected a number"));
    EXPECT_THAT(Files(trace_header + "0,4,nan,0,0,0,0,0,0,0,26,0,1\n", camera).reason,
                HasSubstr("expected a number in column 'x'"));
    EXPECT_THAT(Files(trace_header, camera).reason, HasSubstr("no rows"));
    EXPECT_THAT(
        Files(trace_header + "9,4,0,0,0,0,0,0,0,0,26,0,1\n8,4,0,0,0,0,0,0,0,0,26,0,1\n", camera).reason,
        HasSubstr("line 3: a time before"));
    const std::string trace = trace_header + "0,4,0,0,0,0,0,0,0,0,26,0,1\n";
    EXPECT_THAT(Files(trace, camera, mover_header + "0,-1,0,0,0,0,0,0\n").reason,
                HasSubstr("movers.csv, line 2: expected a whole number from 0 on in column 'mover'"));
    EXPECT_THAT(Files(trace, camera, "t_ms,mover\n").reason, HasSubstr("lacks the column 'x'"));
    std::string crowd = trace_header;
    for (int player = 0; player < 49; ++player)
        crowd += "0," + std::to_string(player) + ",0,0,0,0,0,0,0,0,26,0,1\n";
    EXPECT_THAT(Files(crowd, camera).reason, HasSubstr("trace.csv has more than 48 players"));
}

// A lift that stands until 1000, goes up for two frames, and stands again until 5000.
const std::string lift = mover_header +
                         "0,7,0,0,10,0,0,0\n1000,7,0,0,20,0,350,0\n1050,7,0,0,30,0,10,0\n"
                         "5000,7,0,0,20,0,10,0\n";

TEST(Take, MoversStandUntilTheyMoveAndAreInterpolatedThen) {
    const std::string camera = camera_header + "0,4,0,0,0,1,0,0,0,0\n";
    const Files files(trace_header + "0,4,0,0,0,0,0,0,0,0,26,0,1\n", camera, lift);
    ASSERT_TRUE(files.opened) << files.reason;
    const auto pose = [&](double time) {
        mover_pose result{};
        EXPECT_TRUE(take_mover(&files.content, 7, time, &result));
        EXPECT_EQ(result.model, 7);
        return result;
    };
    EXPECT_EQ(pose(-50).origin[2], 10);
    EXPECT_EQ(pose(999).origin[2], 10);
    EXPECT_EQ(pose(1025).origin[2], 25);
    EXPECT_EQ(pose(1025).angles[1], 360) << "the short way round";
    EXPECT_EQ(pose(4900).origin[2], 30);
    EXPECT_EQ(pose(9000).origin[2], 20);
    mover_pose none{};
    EXPECT_FALSE(take_mover(&files.content, 8, 0, &none));
}

TEST(Take, AMapNeedsNoMovers) {
    const std::string camera = camera_header + "0,4,0,0,0,1,0,0,0,0\n";
    const Files files(trace_header + "0,4,0,0,0,0,0,0,0,0,26,0,1\n", camera, mover_header);
    EXPECT_TRUE(files.opened) << files.reason;
    mover_pose none{};
    EXPECT_FALSE(take_mover(&files.content, 1, 0, &none));
}

int linked = 0;

std::intptr_t count_links(std::intptr_t number, ...) {
    linked += number == ENGINE_LINK_ENTITY ? 1 : 0;
    return 0;
}

// The game's entities as the film module finds them.
class Scenery : public testing::Test {
  protected:
    static constexpr int entity_count = 80, size = entity_shared_size;

    Scenery() {
        linked = 0;
        engine_attach(count_links);
        const std::array<std::intptr_t, engine_call_arguments> data = {
            reinterpret_cast<std::intptr_t>(entities.data()), entity_count, size,
            reinterpret_cast<std::intptr_t>(clients.data()), player_state_size};
        engine_locate(data.data());
        for (int number = 0; number < entity_count; ++number) {
            write_int(entity(number), ENTITY_IN_USE, 1);
            write_int(entity(number), ENTITY_TYPE, ENTITY_TYPE_MOVER);
            write_int(entity(number), ENTITY_BRUSH_MODEL, 1);
        }
        write_int(entity(66), ENTITY_MODEL_INDEX, 7);
    }
    ~Scenery() override { engine_forget_game_data(); }

    std::uint8_t* entity(int number) { return entities.data() + static_cast<std::ptrdiff_t>(number) * size; }

    std::vector<std::uint8_t> entities =
        std::vector<std::uint8_t>(static_cast<std::size_t>(entity_count) * size);
    std::vector<std::uint8_t> clients = std::vector<std::uint8_t>(64 * player_state_size);
    Files files{trace_header + "0,4,0,0,0,0,0,0,0,0,26,0,1\n", camera_header + "0,4,0,0,0,1,0,0,0,0\n", lift};
};

TEST_F(Scenery, TheModelOfTheRecordedNumberIsMovedAndNothingElse) {
    auto expected = entities;
    scenery_pose(&files.content, 1025);
    EXPECT_EQ(linked, 1);
    std::uint8_t* const mover = expected.data() + 66 * size;
    const float origin[3] = {0, 0, 25}, angles[3] = {0, 360, 0};
    write_int(mover, 12, 1);  // position: interpolated between snapshots, base
    write_vector(mover, 24, origin);
    write_int(mover, 48, 1);  // rotation
    write_vector(mover, 60, angles);
    write_vector(mover, ENTITY_ORIGIN, origin);
    write_vector(mover, ENTITY_ANGLES, angles);
    EXPECT_EQ(entities, expected);
}

TEST_F(Scenery, OtherEntitiesOfThatNumberAreLeftAlone) {
    for (const std::size_t field :
         {std::size_t{ENTITY_IN_USE}, std::size_t{ENTITY_TYPE}, std::size_t{ENTITY_BRUSH_MODEL}}) {
        const int before = read_int(entity(66), field);
        write_int(entity(66), field, 0);
        const auto expected = entities;
        scenery_pose(&files.content, 1025);
        EXPECT_EQ(entities, expected);
        write_int(entity(66), field, before);
    }
    EXPECT_EQ(linked, 0);
}

TEST(Take, ADamagedArchiveIsRefused) {
    const test::TemporaryFolder folder;
    const std::string trace = folder / "trace.csv.gz", cameras = folder / "cameras.csv";
    std::ofstream(cameras) << camera_header << "0,4,0,0,0,1,0,0,0,0\n";
    const auto reason_after = [&](auto damage) -> std::string {
        gzFile file = gzopen(trace.c_str(), "wb");
        gzputs(file, trace_header.c_str());
        for (int t = 0; t < 2000; ++t)
            gzprintf(file, "%d,4,%d.%d,0,0,0,0,0,0,0,26,0,1\n", t, t * 7919 % 10007, t);
        gzclose(file);
        damage();
        take content{};
        std::array<char, 1000> text{};
        take_open(&content, trace.c_str(), cameras.c_str(), "", text.data(), text.size());
        take_close(&content);
        return text.data();
    };
    const auto size = [&] { return std::filesystem::file_size(trace); };
    const auto overwrite_at = [&](std::uintmax_t place) {
        std::fstream file(trace, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(place));
        file << "damaged";
    };
    EXPECT_EQ(reason_after([] {}), "");
    EXPECT_THAT(reason_after([&] { overwrite_at(size() - 8); }),
                HasSubstr("damaged or cut off"));  // checksum
    EXPECT_NE(reason_after([&] { overwrite_at(size() / 2); }), "");
    EXPECT_THAT(reason_after([&] { std::filesystem::resize_file(trace, size() / 2); }), HasSubstr("line"));
}

RC_GTEST_PROP(Take, ViewsHaveTheOrientationOfTheFile, ()) {
    const auto degrees = [](int most) { return *rc::gen::inRange(-most, most + 1); };
    const std::array<int, 3> angles = {degrees(89), degrees(179), degrees(179)};
    const auto turned = [](double angle, const Eigen::Vector3d& axis) {
        return Eigen::AngleAxisd(angle * static_cast<double>(EIGEN_PI) / 180.0, axis);
    };
    const Eigen::Quaterniond q(turned(angles[1], Eigen::Vector3d::UnitZ()) *
                               turned(angles[0], Eigen::Vector3d::UnitY()) *
                               turned(angles[2], Eigen::Vector3d::UnitX()));
    std::string row = "0,4,1,2,3";
    for (const double value : {q.w(), q.x(), q.y(), q.z()})
        row += "," + std::to_string(value);
    const Files files(trace_header + "0,4,0,0,0,0,0,0,0,0,26,0,1\n", camera_header + row + ",1\n");
    RC_ASSERT(files.opened);
    bool cut;
    const view shown = take_view(&files.content, tracks_find(&files.content.cameras, 4), 0, 0, &cut);
    for (std::size_t i = 0; i < 3; ++i)
        RC_ASSERT(std::abs(std::remainder(shown.angles[i] - static_cast<float>(angles[i]), 360.0F)) < 0.02);
}

}  // namespace
}  // namespace camdir::openarena
