// bench-cameras on a match of four seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "base/file.hpp"
#include "support/child_process.hpp"
#include "support/freespace_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace camdir {
namespace {

using testing::HasSubstr;

// A hall of 30 x 30 x 8 m with a mesh of balls in its middle. Player 0 walks in a circle of 2.5 m round
// player 1, who looks along x and kills player 0 in front of them.
class BenchCameras : public testing::Test {
  protected:
    void SetUp() override {
        write_map();
        write_freespace();
        write_trace();
        ASSERT_TRUE(write_file(events_, "t_ms,event,player,other\n3000,kill,1,0\n"));
    }

    [[nodiscard]] std::string match() const { return vfs_ + ',' + map_ + ',' + trace_ + ',' + events_; }

    test::TemporaryFolder folder_;
    const std::string map_ = folder_ / "hall.obj";
    const std::string vfs_ = folder_ / "hall.vfs";
    const std::string trace_ = folder_ / "trace.csv";
    const std::string events_ = folder_ / "events.csv";

  private:
    void write_map() const {
        std::ostringstream obj;
        for (int i = 0; i < 8; ++i)
            obj << "v " << ((i & 1) != 0 ? 15 : -15) << ' ' << ((i & 2) != 0 ? 15 : -15) << ' '
                << ((i & 4) != 0 ? 8 : 0) << '\n';
        for (const char* face : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"})
            obj << "f " << face << '\n';
        ASSERT_TRUE(write_file(map_, obj.str()));
    }

    void write_freespace() const {
        freespace::Contents contents = test::empty_contents();
        contents.metadata.map_name = "hall";
        contents.metadata.metres_per_unit = 1.0F;
        contents.metadata.d0 = 0.4F;
        contents.vertices = {{-8, -8, 4, 3.5F}, {8, -8, 4, 3.5F}, {8, 8, 4, 3.5F}, {-8, 8, 4, 3.5F}};
        contents.triangles = {{0, 1, 2}, {0, 2, 3}};
        contents.spawn_points = {{Vec3f(0, 0, 4), 0.0F}};
        ASSERT_TRUE(write_file(vfs_, freespace::encode(contents)));
    }

    void write_trace() const {
        std::ostringstream trace;
        trace << "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
        for (int t = 0; t <= 4000; t += 16) {
            const double angle = 1e-3 * t;
            trace << t << ",0," << 2.5 * std::sin(angle) << ',' << -2.5 * std::cos(angle) << ",3.4,0,"
                  << angle * 180.0 / std::numbers::pi << ",0,0,0,0,0.6,0,0,1\n"
                  << t << ",1,0,0,3.4,0,0,0,0,0,0,0.6,0,0,1\n";
        }
        ASSERT_TRUE(write_file(trace_, trace.str()));
    }
};

TEST_F(BenchCameras, JudgesEveryCameraInOneTable) {
    const std::string csv = folder_ / "table.csv";
    test::ChildProcess process({BENCH_CAMERAS, match(), "--csv", csv});
    ASSERT_EQ(process.wait(), 0) << process.errors();
    EXPECT_EQ(std::ranges::count(process.output(), '\n'), 2 + 15 + 15);
    EXPECT_THAT(process.output(), HasSubstr("| hall | rigid | 100.0 | 100.00 | 0.00 | 0.00 | 0.00 | 0.0 |"));

    const Bytes bytes = read_file(csv).value();
    std::istringstream table(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
    std::string line;
    std::getline(table, line);
    EXPECT_TRUE(
        line.starts_with("match,camera,good,visible_head,clearance_lt4,in_solid,fly_through,dist_err,"));
    int lines = 0;
    for (; std::getline(table, line); ++lines) {
        // Room for every camera: nothing hidden or in a wall, and all frames good, but for those from above.
        const bool from_above = line.find(",tactical") != std::string::npos;
        const std::string good = line.substr(line.find(',', line.find(',') + 1));
        EXPECT_TRUE(good.starts_with(std::string(from_above ? ",0.000000" : ",100.000000") +
                                     ",100.000000,0.000000,0.000000,0.000000,"))
            << line;
        // Behind the player at 120 units, with the player in the middle.
        if (line.find(",rigid,") != std::string::npos) {
            EXPECT_THAT(line, HasSubstr(",0.000000,0.000000,0.000000,100.000000,"));
        }
    }
    EXPECT_EQ(lines, 15 + 15);
}

TEST_F(BenchCameras, RunsTheCamerasThatAreNamed) {
    test::ChildProcess process(
        {BENCH_CAMERAS, match(), match(), "--camera", "HLTV chase", "--camera", "rigid"});
    ASSERT_EQ(process.wait(), 0) << process.errors();
    EXPECT_EQ(std::ranges::count(process.output(), '\n'), 2 + 4 + 2);
    EXPECT_THAT(process.output(), HasSubstr("| mean | HLTV chase |"));
}

// The player turns by 1 radian a second: at 20 cameras a second the rigid one by 2.9 degrees each.
TEST_F(BenchCameras, JudgesAtTheRateThatIsAskedFor) {
    test::ChildProcess process({BENCH_CAMERAS, match(), "--camera", "rigid", "--output-hz", "20"});
    ASSERT_EQ(process.wait(), 0) << process.errors();
    EXPECT_THAT(process.output(), HasSubstr("| 0.00 | 0.00 | 2.9 |"));
}

TEST_F(BenchCameras, SaysWhatIsWrong) {
    test::ChildProcess few({BENCH_CAMERAS, vfs_ + ',' + map_});
    EXPECT_EQ(few.wait(), 1);
    EXPECT_THAT(few.errors(), HasSubstr("expected VFS,MAP,TRACE or VFS,MAP,TRACE,EVENTS"));
    test::ChildProcess nobody({BENCH_CAMERAS, match(), "--camera", "drone"});
    EXPECT_EQ(nobody.wait(), 1);
    EXPECT_THAT(nobody.errors(), HasSubstr("no camera \"drone\""));
    ASSERT_TRUE(write_file(events_, "t_ms,event,player,other\n3000,kill,1,7\n"));
    test::ChildProcess stranger({BENCH_CAMERAS, match()});
    EXPECT_EQ(stranger.wait(), 1);
    EXPECT_THAT(stranger.errors(), HasSubstr("events.csv:2: column \"other\" is 7, expected a player"));
    test::ChildProcess nothing({BENCH_CAMERAS});
    EXPECT_EQ(nothing.wait(), 2);
}

}  // namespace
}  // namespace camdir
