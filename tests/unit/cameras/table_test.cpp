#include "bench/cameras/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace camdir::bench {
namespace {

Row row(const char* match, const char* camera, double good) {
    Row row;
    row.match = match;
    row.camera = camera;
    row.metrics.good = good;
    return row;
}

TEST(CameraTable, EndsWithTheMeansOfWhatWasMeasured) {
    std::vector<Row> rows{row("dm1", "rigid", 60), row("dm1", "arm", 80), row("dm2", "rigid", 75)};
    rows[0].metrics.kill_in_view = 12.5;
    rows[2].ns_p50 = 41.6;
    const std::string csv = to_csv(rows);
    EXPECT_EQ(
        csv.substr(0, csv.find('\n')),
        "match,camera,good,visible_head,clearance_lt4,in_solid,fly_through,dist_err,too_close,behind,"
        "in_frame,acc p95,acc p99,ang_speed p95,comfort,kill_in_view,pops,cuts,max_rotation,ns p50,ns p99");
    EXPECT_THAT(csv, testing::HasSubstr("\ndm1,arm,80.000000,,"));
    EXPECT_THAT(csv, testing::HasSubstr("\nmean,rigid,67.500000,,,,,,,,,,,,,12.500000,,,,41.600000,\n"
                                        "mean,arm,80.000000,,,,,,,,,,,,,,,,,,\n"));
    EXPECT_TRUE(csv.ends_with("mean,arm,80.000000,,,,,,,,,,,,,,,,,,\n"));

    const std::string markdown = to_markdown(rows);
    EXPECT_EQ(std::ranges::count(markdown, '\n'), 2 + 3 + 2);
    EXPECT_THAT(markdown, testing::HasSubstr("\n| dm2 | rigid | 75.0 |  |"));
    EXPECT_THAT(markdown, testing::HasSubstr("\n| mean | rigid | 67.5 |  |"));
}

}  // namespace
}  // namespace camdir::bench
