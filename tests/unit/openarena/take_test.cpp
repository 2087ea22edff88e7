// The recorded matches and camera paths that film.sh plays.
#include "film/take.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <fstream>
#include <string>

#include "support/temporary_folder.hpp"

namespace camdir::openarena {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string trace_header = "t_ms,player,x,y,z,pitch,yaw,vx,vy,vz,viewheight,teleport_bit,alive\n";
const std::string camera_header = "t_ms,player,x,y,z,qw,qx,qy,qz,cut\n";

// Opens what is written into two files.
class Files {
  public:
    Files(const std::string& trace, const std::string& cameras) {
        std::ofstream(folder_ / "trace.csv") << trace;
        std::ofstream(folder_ / "cameras.csv") << cameras;
        std::array<char, 1000> text{};
        opened = take_open(&content, (folder_ / "trace.csv").c_str(), (folder_ / "cameras.csv").c_str(),
                           text.data(), text.size());
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
