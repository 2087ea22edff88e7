#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>

#include "box_scene.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/mover_figures.hpp"
#include "evaluation/mover_tracks.hpp"
#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

using testing::HasSubstr;

// A wall across the middle of the room, in its own frame at y = 0, with the number 4.
scene::Mover moving_wall() {
    scene::Scene box;
    add_box(box, Vec3d(-8.0, -50.0, 0.0), Vec3d(8.0, 50.0, 200.0));
    return {"*4", "func_door", {{box.planes, box.bounds}}, Vec3d::Zero()};
}

// A frame every 100 ms, 0 .. 1200; the player stands at (100, 0, 100) and looks along x.
Trace trace_beside_wall() {
    Trace trace;
    trace.players = {0};
    for (std::int64_t t = 0; t <= 1'200; t += 100)
        add_frame(trace, t, {standing(0, Vec3d(100.0, 0.0, 100.0))});
    return trace;
}

std::vector<MoverRow> mover_rows_of(std::string_view text) {
    return parse_movers(std::as_bytes(std::span(text)), "movers.csv").value();
}

std::string mover_error_of(std::string_view text) {
    const auto rows = parse_movers(std::as_bytes(std::span(text)), "movers.csv");
    return rows ? "" : rows.error().message;
}

constexpr std::string_view mover_header = "t_ms,mover,x,y,z,pitch,yaw,roll\n";

TEST(MoverRows, AreReadInQuakesAxes) {
    const auto rows =
        mover_rows_of("mover,t_ms,z,y,x,roll,yaw,pitch,more\n4,12.5,3,2,1,0,90,0,x\n7,12.5,0,0,0,0,0,90,x\n");
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_EQ(rows[0].time, 12'500'000);
    EXPECT_EQ(rows[0].model, 4U);
    EXPECT_EQ(rows[0].placement.position, Vec3d(1.0, 2.0, 3.0));
    EXPECT_TRUE((rows[0].placement.orientation * Vec3d::UnitX()).isApprox(Vec3d::UnitY(), 1e-9));
    EXPECT_TRUE((rows[1].placement.orientation * Vec3d::UnitX()).isApprox(-Vec3d::UnitZ(), 1e-9));
}

TEST(MoverRows, ErrorsSayWhatIsWrong) {
    const std::string rows(mover_header);
    EXPECT_THAT(mover_error_of("t_ms,mover,x,y,z\n"),
                HasSubstr("movers.csv:1: the header lacks the column \"pitch\""));
    EXPECT_THAT(mover_error_of(rows + "5,1,0,0,0,0,0,0\n4,1,0,0,0,0,0,0\n"),
                HasSubstr("movers.csv:3: column \"t_ms\" goes back"));
    EXPECT_THAT(mover_error_of(rows + "5,-1,0,0,0,0,0,0\n"), HasSubstr("column \"mover\" is \"-1\""));
    EXPECT_THAT(mover_error_of(rows + "5,1,nan,0,0,0,0,0\n"), HasSubstr("column \"x\" is \"nan\""));
    EXPECT_EQ(mover_error_of(rows), "") << "a map may have no movers";
}

TEST(MoverTracks, StandStillWhereTheyHaveNoRowAndMoveBetweenFrames) {
    const Trace trace = trace_beside_wall();
    const std::vector<scene::Mover> movers = {moving_wall()};
    const auto rows =
        mover_rows_of(std::string(mover_header) +
                      "100,4,0,0,0,0,0,0\n100,9,5,0,0,0,0,0\n400,4,0,10,0,0,60,0\n500,4,0,30,0,0,60,0\n");
    const MoverTracks tracks(rows, movers, trace);
    const auto y_at = [&](std::int64_t ms) { return tracks.at(0, ms * 1'000'000)->position.y(); };
    EXPECT_FALSE(tracks.at(0, 99'000'000)) << "not seen yet";
    EXPECT_EQ(y_at(100), 0.0);
    EXPECT_EQ(y_at(300), 0.0);
    EXPECT_NEAR(y_at(350), 5.0, 1e-9);
    EXPECT_NEAR(y_at(400), 10.0, 1e-9);
    EXPECT_NEAR(y_at(450), 20.0, 1e-9);
    EXPECT_EQ(y_at(500), 30.0);
    EXPECT_EQ(y_at(99'000), 30.0);
    const Vec3d forward = tracks.at(0, 350'000'000)->orientation * Vec3d::UnitX();
    EXPECT_TRUE(forward.isApprox(Vec3d(std::cos(30.0 * radians_of_a_degree<double>), 0.5, 0.0), 1e-6));
}

// The figures of cameras that stand at `positions` from 600 ms on, one a frame.
MoverFigures mover_figures_of(const std::vector<Vec3d>& positions, std::string_view movers,
                              bool claims_sight = true, bool cut = false) {
    const Trace trace = trace_beside_wall();
    CameraPath cameras(trace.poses.size());
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const std::size_t place = i < 6 ? 0 : i - 6;
        cameras[i].position = positions[std::min(place, positions.size() - 1)];
        cameras[i].cut = cut;
        cameras[i].claims_sight = claims_sight;
    }
    const scene::Scene scene = room();
    const oracle::Oracle oracle(scene);
    const auto reachability = oracle::Reachability::explore(oracle, scene, {}, {}).value();
    const auto judgements =
        judge(oracle, reachability, Thresholds(scene.metres_per_unit), trace, cameras, {}).value();
    const std::vector<scene::Mover> all = {moving_wall()};
    const MoverTracks tracks(mover_rows_of(std::string(mover_header) + std::string(movers)), all, trace);
    return judge_movers(all, tracks, trace, cameras, judgements, {}).value();
}

const Vec3d before_it(-60.0, 0.0, 100.0), in_it(0.0, 0.0, 100.0), beyond_it(60.0, 0.0, 100.0),
    beside_it(0.0, 60.0, 100.0);

TEST(MoverFigures, CountWhatMoversHide) {
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,0,0,0,0,0\n").seen_through, 7U) << "of 600 .. 1200 ms";
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,0,0,0,0,0\n", false).seen_through, 0U);
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,200,0,0,0,0\n").seen_through, 0U) << "it is beside";
    EXPECT_EQ(mover_figures_of({before_it}, "0,5,0,0,0,0,0,0\n").seen_through, 0U) << "another model";
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,55,0,0,0,0\n").seen_through, 0U);
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,55,0,0,90,0\n").seen_through, 0U);
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,5,0,0,90,0\n").seen_through, 7U)
        << "turned along the view";
    EXPECT_EQ(mover_figures_of({before_it}, "0,4,0,0,0,0,0,0\n900,4,0,100,0,0,0,0\n").seen_through, 3U);
}

TEST(MoverFigures, CountCamerasInMoversAndPassages) {
    const MoverFigures crossing = mover_figures_of({before_it, in_it, beyond_it}, "0,4,0,0,0,0,0,0\n");
    EXPECT_EQ(crossing.frames_inside, 1U);
    EXPECT_EQ(crossing.passages, 2U) << "in and out";
    const MoverFigures leap = mover_figures_of({before_it, beyond_it}, "0,4,0,0,0,0,0,0\n");
    EXPECT_EQ(leap.frames_inside, 0U);
    EXPECT_EQ(leap.passages, 1U);
    EXPECT_EQ(mover_figures_of({before_it, beyond_it}, "0,4,0,0,0,0,0,0\n", true, true).passages, 0U)
        << "declared";
    const MoverFigures run_over =
        mover_figures_of({in_it}, "0,4,0,100,0,0,0,0\n900,4,0,100,0,0,0,0\n1000,4,0,-100,0,0,0,0\n");
    EXPECT_EQ(run_over.frames_inside, 0U);
    EXPECT_EQ(run_over.passages, 1U) << "the mover comes over the camera";
    const MoverFigures carried = mover_figures_of({beside_it, beside_it + Vec3d(0.0, 100.0, 0.0)},
                                                  "0,4,0,0,0,0,0,0\n700,4,0,100,0,0,0,0\n");
    EXPECT_EQ(carried.passages, 0U) << "both move alike";
}

TEST(MoverFigures, AreNamedInTableAndJson) {
    Metrics metrics;
    EXPECT_THAT(to_json(metrics), testing::Not(HasSubstr("mover")));
    metrics.movers = MoverFigures{1, 2, 3};
    EXPECT_THAT(to_json(metrics),
                testing::AllOf(HasSubstr("\"mover_frames_inside\": 1"), HasSubstr("\"mover_passages\": 2"),
                               HasSubstr("\"mover_seen_through\": 3")));
    EXPECT_THAT(to_table(metrics), HasSubstr("mover_seen_through 3 frames"));
}

}  // namespace
}  // namespace camdir::evaluation
