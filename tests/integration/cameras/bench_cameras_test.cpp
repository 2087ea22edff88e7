// bench-cameras on a match of four seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "base/file.hpp"
#include "hall_match.hpp"
#include "support/child_process.hpp"

namespace camdir {
namespace {

using testing::HasSubstr;

class BenchCameras : public HallMatch {
  protected:
    [[nodiscard]] std::string match() const { return vfs_ + ',' + map_ + ',' + trace_ + ',' + events_; }
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
