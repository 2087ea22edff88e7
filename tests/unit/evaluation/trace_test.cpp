#include "evaluation/trace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "evaluation/lines.hpp"
#include "gzip.hpp"
#include "support/shared_files.hpp"

namespace camdir::evaluation {
namespace {

using test::gzip;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr const char* header =
    "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,health,team,teleport_bit,alive\n";

Result<Trace> trace_in(const std::string& text) {
    return parse_trace(std::as_bytes(std::span(text)), "match.csv");
}

std::string error_of(const std::string& text) {
    const auto trace = trace_in(text);
    return trace ? "no error" : trace.error().message;
}

TEST(Trace, ReadsAPose) {
    const auto trace = trace_in(std::string(header) + "8,3,1.5,-2,10,30,-270,0,4,5,6,26,99,2,1,1\n");
    ASSERT_TRUE(trace) << trace.error().message;
    ASSERT_EQ(trace->poses.size(), 1U);
    const TracePose& pose = trace->poses[0];
    EXPECT_EQ(trace->frames[0].time, 8'000'000);
    EXPECT_EQ(pose.player, 3U);
    EXPECT_EQ(pose.eye, Vec3d(1.5, -2, 36));
    EXPECT_EQ(pose.origin(), Vec3d(1.5, -2, 10));
    EXPECT_EQ(pose.velocity, Vec3d(4, 5, 6));
    EXPECT_EQ(pose.team, 2);
    EXPECT_TRUE(pose.alive);
    const Vec3d forward = pose.orientation * Vec3d::UnitX();
    EXPECT_LT((forward - Vec3d(0, std::sqrt(0.75), -0.5)).norm(), 1e-12) << "pitch 30 looks down";
}

// Quake's own definition of forward, right and up from view angles.
TEST(Trace, OrientationMatchesQuakesAngleVectors) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(-720.0, 720.0);
    for (int i = 0; i < 1000; ++i) {
        const double pitch = angle(random), yaw = angle(random), roll = angle(random);
        constexpr double radians = std::numbers::pi / 180.0;
        const double sp = std::sin(pitch * radians), cp = std::cos(pitch * radians);
        const double sy = std::sin(yaw * radians), cy = std::cos(yaw * radians);
        const double sr = std::sin(roll * radians), cr = std::cos(roll * radians);
        const Vec3d forward(cp * cy, cp * sy, -sp);
        const Vec3d right(-sr * sp * cy + cr * sy, -sr * sp * sy - cr * cy, -sr * cp);
        const Vec3d up(cr * sp * cy + sr * sy, cr * sp * sy - sr * cy, cr * cp);
        const Eigen::Matrix3d axes = quake_orientation(pitch, yaw, roll).toRotationMatrix();
        EXPECT_LT((axes.col(0) - forward).norm(), 1e-12);
        EXPECT_LT((axes.col(1) + right).norm(), 1e-12);
        EXPECT_LT((axes.col(2) - up).norm(), 1e-12);
    }
}

TEST(Trace, FindsColumnsByName) {
    const auto trace = trace_in(
        "alive,extra,teleport_bit,team,viewheight,vz,vy,vx,roll,yaw,pitch,z,y,x,player,t_ms\r\n"
        "1,7,0,0,26,0,0,0,0,0,0,3,2,1,5,16.5\r\n");
    ASSERT_TRUE(trace) << trace.error().message;
    EXPECT_EQ(trace->frames[0].time, 16'500'000);
    EXPECT_EQ(trace->poses[0].player, 5U);
    EXPECT_EQ(trace->poses[0].eye, Vec3d(1, 2, 29));
}

TEST(Trace, GroupsFramesAndOrdersPlayers) {
    const auto trace = trace_in(std::string(header) +
                                "8,2,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n"
                                "8,1,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n"
                                "24,1,0,0,0,0,0,0,0,0,0,26,1,0,0,1");
    ASSERT_TRUE(trace) << trace.error().message;
    EXPECT_THAT(trace->players, ElementsAre(1, 2));
    ASSERT_EQ(trace->frames.size(), 2U);
    EXPECT_EQ(trace->poses_of(trace->frames[0])[0].player, 1U);
    EXPECT_EQ(trace->poses_of(trace->frames[0])[1].player, 2U);
    EXPECT_THAT(track_of(*trace, 1), ElementsAre(0, 2));
    EXPECT_THAT(track_of(*trace, 2), ElementsAre(1, absent));
}

// Player 1 teleports at 24, dies at 32, is respawned without a toggle at 40; it is missing at 56.
TEST(Trace, MarksDiscontinuities) {
    std::string text = header;
    for (const char* row : {"8,1,%,0,1", "16,1,%,0,1", "24,1,%,1,1", "32,1,%,1,0", "40,1,%,1,1", "48,1,%,1,1",
                            "56,2,%,0,1", "64,1,%,1,1"}) {
        std::string line = row;
        line.replace(line.find('%'), 1, "0,0,0,0,0,0,0,0,0,26,1,0");
        text += line + "\n";
    }
    const auto trace = trace_in(text);
    ASSERT_TRUE(trace) << trace.error().message;
    std::vector<bool> marks;
    for (const TracePose& pose : trace->poses)
        if (pose.player == 1) marks.push_back(pose.discontinuity);
    EXPECT_THAT(marks, ElementsAre(true, false, true, false, true, false, true));
}

TEST(Trace, ErrorsNameLineColumnAndExpectation) {
    const std::string good = "8,0,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n";
    const std::string start = header + good;
    EXPECT_EQ(error_of(""), "match.csv: empty, expected a header line");
    EXPECT_EQ(error_of(header), "match.csv: no rows, expected at least one frame");
    EXPECT_THAT(error_of("t_ms,player\n"), HasSubstr("match.csv:1: the header lacks the column \"x\""));
    EXPECT_THAT(error_of("x," + start),
                HasSubstr("match.csv:1: the header has the column \"x\" more than once"));
    EXPECT_EQ(error_of(start + "24,0,0,0,0,up,0,0,0,0,0,26,1,0,0,1\n"),
              "match.csv:3: column \"pitch\" is \"up\", expected a number from -1e+06 to 1e+06");
    EXPECT_THAT(error_of(start + "24,0,0,0,0,nan,0,0,0,0,0,26,1,0,0,1\n"), HasSubstr("column \"pitch\""));
    EXPECT_THAT(error_of(start + "24,0,0,0,0,,0,0,0,0,0,26,1,0,0,1\n"), HasSubstr("column \"pitch\""));
    EXPECT_THAT(error_of(start + "24,0,inf,0,0,0,0,0,0,0,0,26,1,0,0,1\n"), HasSubstr("column \"x\""));
    EXPECT_THAT(error_of(start + "24,0.5,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n"),
                HasSubstr("column \"player\" is \"0.5\", expected an integer"));
    EXPECT_THAT(error_of(start + "24,0,0\n"), HasSubstr("match.csv:3: 3 fields, expected 16"));
    EXPECT_THAT(error_of(start + "4,0,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n"), HasSubstr("\"t_ms\" goes back"));
    EXPECT_THAT(error_of(start + good), HasSubstr("a second row for player 0"));
    EXPECT_THAT(error_of(start + std::string(5000, '1')), HasSubstr("longer than 4096"));
    std::string crowd = header;
    for (int i = 0; i < 257; ++i)
        crowd += "8," + std::to_string(i) + ",0,0,0,0,0,0,0,0,0,26,1,0,0,1\n";
    EXPECT_THAT(error_of(crowd), HasSubstr("match.csv:258: column \"player\" has more than 256"));
}

TEST(Trace, ReadsGzipWithSeveralMembers) {
    const std::string first = header;
    const std::string second = "8,0,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n16,0,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n";
    const auto trace = trace_in(gzip(first) + gzip(second));
    ASSERT_TRUE(trace) << trace.error().message;
    EXPECT_EQ(trace->frames.size(), 2U);
}

TEST(Trace, ReadsWhatSpreadsheetsWrite) {
    std::string text = header;
    text += "8,0,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n";
    const auto trace = trace_in("\xEF\xBB\xBF" + text);
    ASSERT_TRUE(trace) << trace.error().message;
    EXPECT_EQ(trace->frames.size(), 1U);
    EXPECT_FALSE(trace_in("\xEF\xBB" + text));
}

TEST(Trace, RefusesDamagedGzip) {
    std::string text = header;
    for (int i = 0; i < 2000; ++i)
        text += std::to_string(8 * i) + ",0,0,0,0,0,0,0,0,0,0,26,1,0,0,1\n";
    const std::string packed = gzip(text);
    ASSERT_TRUE(trace_in(packed));
    EXPECT_THAT(error_of(packed.substr(0, packed.size() / 2)), HasSubstr("end too early"));
    std::string damaged = packed;
    for (std::size_t i = 40; i < 60; ++i)
        damaged[i] = '\x55';
    EXPECT_FALSE(trace_in(damaged));
}

TEST(Trace, RefusesTextThatExpandsTooFar) {
    std::string text;
    for (int i = 0; i < 1 << 20; ++i)
        text += "0000000000000000\n";
    const std::string bomb = gzip(text);
    ASSERT_LT(bomb.size() * 300, text.size());
    std::size_t lines = 0;
    const auto read = for_each_line(std::as_bytes(std::span(bomb)), [&](std::string_view) {
        ++lines;
        return Result<void>{};
    });
    ASSERT_FALSE(read);
    EXPECT_THAT(read.error().message, HasSubstr("decompresses to more than"));
    EXPECT_LT(lines * 17, (std::size_t{1} << 20) + 200 * bomb.size() + 1);
}

// Whatever the bytes: an error, or a trace that keeps its invariants.
TEST(Trace, RandomDamageNeverBreaksInvariants) {
    std::string text = header;
    for (int i = 0; i < 40; ++i)
        text += std::to_string(8 * (i / 2)) + "," + std::to_string(i % 2) + ",1,2,3,4,5,6,7,8,9,26,1,0,0,1\n";
    std::mt19937 random(11);
    int accepted = 0;
    for (int round = 0; round < 3000; ++round) {
        std::string broken = text;
        for (int i = 0; i < 2; ++i)
            broken[random() % broken.size()] = static_cast<char>("0123456789,\n.-e"[random() % 15]);
        const auto trace = trace_in(broken);
        if (!trace) continue;
        ++accepted;
        std::uint32_t next = 0;
        for (const TraceFrame& frame : trace->frames) {
            ASSERT_EQ(frame.first_pose, next);
            ASSERT_GE(frame.pose_count, 1U);
            next += frame.pose_count;
            for (const TracePose& pose : trace->poses_of(frame)) {
                ASSERT_TRUE(pose.eye.allFinite());
                ASSERT_NEAR(pose.orientation.norm(), 1.0, 1e-12);
            }
        }
        ASSERT_EQ(next, trace->poses.size());
    }
    EXPECT_GT(accepted, 100);
}

TEST(Trace, ReadsRecordedMatches) {
    const std::string name = "traces/oa_dm1-60hz.csv.gz";
    const auto path = test::shared_file(name);
    if (!path) GTEST_SKIP() << test::needs_shared_file(name);
    const auto trace = read_trace(*path);
    ASSERT_TRUE(trace) << trace.error().message;
    EXPECT_THAT(trace->players, ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
    EXPECT_EQ(trace->poses.size(), trace->frames.size() * 8);
    EXPECT_NEAR(static_cast<double>(trace->frames.back().time - trace->frames.front().time) * 1e-9, 155.0,
                2.0);
}

}  // namespace
}  // namespace camdir::evaluation
