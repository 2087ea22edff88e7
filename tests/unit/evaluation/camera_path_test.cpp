#include "evaluation/camera_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

using testing::HasSubstr;

Trace two_players() {
    Trace trace;
    trace.players = {1, 2};
    add_frame(trace, 8, {standing(1, {0, 0, 0}), standing(2, {9, 0, 0})});
    add_frame(trace, 24, {standing(2, {9, 0, 0})});
    trace.frames.back().time += 666'667;
    return trace;
}

Result<CameraPath> parse(const std::string& text, const Trace& trace) {
    return parse_cameras(std::as_bytes(std::span(text)), "cameras.csv", trace);
}

TEST(CameraPath, WritesTheContractsColumns) {
    const Trace trace = two_players();
    CameraPath cameras(3);
    cameras[0] = {Vec3d(1, -2.25, 0.00001), Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5), true};
    EXPECT_EQ(format_cameras(trace, cameras),
              "t_ms,player,x,y,z,qw,qx,qy,qz,cut\n"
              "8,1,1.00000,-2.25000,0.00001,0.500000000,0.500000000,-0.500000000,0.500000000,1\n"
              "8,2,0.00000,0.00000,0.00000,1.000000000,0.000000000,0.000000000,0.000000000,0\n"
              "24.666667,2,0.00000,0.00000,0.00000,1.000000000,0.000000000,0.000000000,0.000000000,0\n");
}

TEST(CameraPath, SurvivesTheFile) {
    const Trace trace = two_players();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> coordinate(-5000, 5000);
    for (int round = 0; round < 200; ++round) {
        CameraPath cameras;
        for (std::size_t i = 0; i < trace.poses.size(); ++i)
            cameras.push_back({Vec3d(coordinate(random), coordinate(random), coordinate(random)),
                               quake_orientation(coordinate(random), coordinate(random), coordinate(random)),
                               i == 1});
        const auto read = parse(format_cameras(trace, cameras), trace);
        ASSERT_TRUE(read) << read.error().message;
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            EXPECT_LT(((*read)[i].position - cameras[i].position).norm(), 1e-5);
            EXPECT_LT((*read)[i].orientation.angularDistance(cameras[i].orientation), 1e-7);
            EXPECT_EQ((*read)[i].cut, cameras[i].cut);
        }
    }
}

TEST(CameraPath, ErrorsNameTheRow) {
    const Trace trace = two_players();
    const std::string text = format_cameras(trace, CameraPath(3));
    const auto error_of = [&](const std::string& broken) {
        const auto read = parse(broken, trace);
        return read ? "no error" : read.error().message;
    };
    std::string lines[4];
    std::size_t start = 0;
    for (std::string& line : lines) {
        const std::size_t end = text.find('\n', start) + 1;
        line = text.substr(start, end - start);
        start = end;
    }
    EXPECT_EQ(error_of(lines[0] + lines[2] + lines[1] + lines[3]), "no error");
    EXPECT_EQ(error_of(lines[0] + lines[1] + lines[3]), "cameras.csv:3: no row for player 2 at t_ms 8");
    EXPECT_EQ(error_of(lines[0] + lines[1] + lines[2]), "cameras.csv: no row for player 2 at t_ms 24.666667");
    EXPECT_EQ(error_of(lines[0] + lines[1] + lines[1]), "cameras.csv:3: a second row for player 1 at t_ms 8");
    EXPECT_EQ(error_of(lines[0] + "9" + lines[1].substr(1)), "cameras.csv:2: no row for player 1 at t_ms 8");
    EXPECT_EQ(error_of(text + lines[1]),
              "cameras.csv:5: a row for player 1 at t_ms 8, which the trace lacks");
    EXPECT_THAT(error_of(lines[0] + "8,1,0,0,0,0.9,0,0,0,0\n"), HasSubstr("length is 0.9"));
    EXPECT_THAT(error_of(lines[0] + "8,1,0,0,0,1,0,0,0,2\n"), HasSubstr("column \"cut\" is \"2\""));
}

}  // namespace
}  // namespace camdir::evaluation
